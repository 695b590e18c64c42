// tests/stereo_study/study.h: how good depth is on the larger data; tests judge it, the benchmark
// prints it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "eval/images/depth_errors.h"
#include "eval/images/disparity_errors.h"
#include "eval/surfaces/surface_alignment.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope::test {

/// One pair with true disparity, measured by ELAS and by SGBM.
struct PairScore {
  std::string name;
  DisparityErrors elas, sgbm;
  double elas_common_median_px = 0, sgbm_common_median_px = 0;  // where both measured
};

/// bdis_tissue: eight rendered tissue pairs.
std::vector<PairScore> scoreTissuePairs(const std::filesystem::path& folder);

/// libelas_pairs: aloe against its ground truth.
PairScore scoreAloe(const std::filesystem::path& folder);

/// Against the stored output of libelas, 8-bit, 255 = `disparity_max_px`.
struct Agreement {
  double within_1px_percent = 0;                // of the pixels that both measured
  double ours_percent = 0, theirs_percent = 0;  // measured, of all pixels
};
Agreement agreeWithLibelas(const std::filesystem::path& folder, const std::string& name,
                           double disparity_max_px);

/// A frame's depth against the sequence's truth or reference.
struct FrameScore {
  int frame = 0;
  DepthErrors errors;  // over the pixels that both cameras see, masked ones left out
  RowAlignment rows;
};

/// All frames of a sequence, and all their absolute depth errors at once.
struct SequenceScore {
  std::vector<FrameScore> frames;
  Statistics pooled_mm;
  double mean_coverage_percent = 0;  // of the frames with truth
  int failed_frames = 0;             // that could not be read or measured
};

/// A sequence folder with `truth`/NNNNNN.png (16-bit, 0.01 mm) for some of
/// its frames. Frames without truth are measured too; their errors are empty.
SequenceScore scoreSequence(const std::filesystem::path& folder, const std::string& truth);

/// opencas_ct: depth from the raw pair, in the raw left frame, against the CT patch.
struct CtScore {
  SurfaceAlignment alignment;
  RowAlignment rows;
  std::size_t points = 0;
};
CtScore scoreOpencas(const std::filesystem::path& folder, bool align_rows);

}  // namespace softscope::test
