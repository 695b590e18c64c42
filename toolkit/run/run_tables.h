// toolkit/run/run_tables.h: rows of frames.csv, images.csv and tracks.csv.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/sequences/frame_names.h"
#include "pipeline/frame_record.h"

namespace softscope {

/// Headings, without the newline. Missing values are empty cells
/// in frames.csv and nan in tracks.csv. Columns: docs/formats.md.
std::string framesCsvHeading();
std::string tracksCsvHeading();
std::string imagesCsvHeading();

/// One row with its newline.
std::string framesCsvLine(const FrameRecord& record);

/// Values of a row that sums over a run need: frame, status, map, points, nodes, inliers,
/// mean back-projection and prediction, times. Throws InputError with `name`.
FrameRecord readFramesCsvLine(std::string_view line, const std::string& name);

/// Rows of frames.csv in which the frames of one map are of another: as they are after a join.
std::string moveRows(const std::string& rows, const MapJoin& join);

/// Record rounded as in frames.csv: a resumed run
/// has the same sums as an uninterrupted one.
FrameRecord asTabled(const FrameRecord& record);

/// Image files of the frame.
std::string imagesCsvLine(int frame, const FrameNames& names);

/// One row per tracked point.
std::string tracksCsvLines(const FrameRecord& record);

/// Timed stages of frames.csv, in its order.
const std::vector<std::string>& timedStages();

}  // namespace softscope
