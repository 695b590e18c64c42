// toolkit/run/run_tables.h: frames.csv, images.csv and tracks.csv, line by line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/sequences/frame_names.h"
#include "pipeline/frame_record.h"

namespace softscope {

/// Headings, without the newline. What a frame doesn't have is an empty cell of frames.csv; a
/// tracked point that was never found has nan in tracks.csv. docs/formats.md explains the columns.
std::string framesCsvHeading();
std::string tracksCsvHeading();
std::string imagesCsvHeading();

/// One line, with its newline.
std::string framesCsvLine(const FrameRecord& record);

/// Of such a line what sums over a run need: frame, status, points, nodes, inliers, mean
/// back-projection and prediction, times. Throws InputError naming `name`.
FrameRecord readFramesCsvLine(std::string_view line, const std::string& name);

/// What frames.csv keeps of it: a run that goes on after a stop then sums the same numbers as one
/// that was never stopped.
FrameRecord asTabled(const FrameRecord& record);

/// Which files the frame was made of.
std::string imagesCsvLine(int frame, const FrameNames& names);

/// One line a tracked point.
std::string tracksCsvLines(const FrameRecord& record);

/// The stages that frames.csv has times of, in its order.
const std::vector<std::string>& timedStages();

}  // namespace softscope
