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

/// Of one frame, rendered from the pose of the run.
struct ViewErrors {
  DepthErrors depth;  // rendered model against true depth
  /// Against the left image; NaN for a sequence without images or a model without colours.
  PictureErrors picture;
};

/// Rectified left image, and the model rendered from the same pose,
/// mid-grey without a model. Empty without an image or without colours.
struct DrawnPair {
  ColourImage image, model;
};

/// Description of the pixels compared by PSNR and SSIM.
inline constexpr const char* kPsnrMask =
    "pixels that the model covers, without masks and black borders";

/// Renders models and compares them with the left images of the sequence. Excludes masked
/// pixels and pixels without a model. Frames must be requested in ascending order.
class ViewJudge {
 public:
  explicit ViewJudge(const SequenceTruth& truth);

  /// Throws InputError for an unreadable image or one of
  /// another size. `drawn`: the compared images; may be null.
  ViewErrors judge(const ModelFile& file, const Eigen::Isometry3d& run_from_left, int frame,
                   const Raster<float>& true_depth_mm, DrawnPair* drawn = nullptr);
  /// Control: the image of `other`, an earlier frame, against that of
  /// `frame`, which must be the last evaluated frame, over the same pixels.
  PictureErrors judgeImage(const ModelFile& file, const Eigen::Isometry3d& run_from_left, int other,
                           int frame);

 private:
  std::optional<ColourImage> photograph(int frame);
  Mask instruments(int frame) const;

  RectifiedRig rig_;
  Rectifier rectifier_;
  std::vector<std::filesystem::path> pictures_, masks_;  // by frame
  bool tissue_masks_ = false;                            // form of masks_; some are empty
  std::unique_ptr<FrameLoader> video_;                   // instead of pictures_
};

}  // namespace softscope
