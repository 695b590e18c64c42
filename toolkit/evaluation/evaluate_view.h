// toolkit/evaluation/evaluate_view.h: the rendered model against the image of its frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "eval/images/depth_errors.h"
#include "eval/images/picture_errors.h"
#include "io/sequences/frame_loader.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// Of one moment, drawn from the run's own pose.
struct ViewErrors {
  DepthErrors depth;  // of the drawn model, against the true depth
  /// Against the left image; NaN where the sequence has none, or the model no colours.
  PictureErrors picture;
};

/// The moment's left image, rectified, and the model drawn from the same place; mid-grey where it
/// shows nothing. Empty where there is no image, or the model has no colours.
struct DrawnPair {
  ColourImage image, model;
};

/// In words: which pixels PSNR and SSIM are of.
inline constexpr const char* kPsnrMask =
    "pixels that the model covers, without masks and black borders";

/// Draws models and compares them with the sequence's left images. Pixels where the model shows
/// nothing, and masked ones, aren't judged. Frames must be asked for in rising order.
class ViewJudge {
 public:
  explicit ViewJudge(const SequenceTruth& truth);

  /// Throws InputError where an image can't be read or has another size. `drawn`: what was
  /// compared, unless null.
  ViewErrors judge(const ModelFile& file, const Eigen::Isometry3d& run_from_left, int frame,
                   const Raster<float>& true_depth_mm, DrawnPair* drawn = nullptr);
  /// The same pixels of the image of `other`, an earlier frame, against that of `frame`, which was
  /// judged last: what a model that shows the earlier frame for good would get.
  PictureErrors judgeImage(const ModelFile& file, const Eigen::Isometry3d& run_from_left, int other,
                           int frame);

 private:
  std::optional<ColourImage> photograph(int frame);
  Mask instruments(int frame) const;

  RectifiedRig rig_;
  Rectifier rectifier_;
  std::vector<std::filesystem::path> pictures_, masks_;  // in the order of frames
  std::unique_ptr<FrameLoader> video_;                   // in place of pictures_
};

}  // namespace softscope
