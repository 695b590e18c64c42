// src/pipeline/frame/model_matches.h: stages 2 and 3: from model view and live image to lifted
// matches.
#pragma once

#include <vector>

#include "features/lift_matches.h"
#include "features/matcher.h"
#include "pipeline/frame/frame_depth.h"
#include "pipeline/options/reconstruction_options.h"

namespace softscope {

/// What of a frame is no tissue: its mask with a margin, and its border. Of the size of `left`, the
/// rectified image.
Mask notTissue(const ColourImage& left, const MeasuredFrame& frame,
               const TissueMaskOptions& options);

/// The rectified left image as it is matched: without what is no tissue, without highlights.
MatchPicture livePicture(const ColourImage& left, GrayImage gray, const Mask& not_tissue);

struct ModelMatches {
  std::vector<PixelMatch> pixels;
  std::vector<LiftedMatch> lifted;  // of those, with depth on both sides
};

/// The view as it is matched: with its anchors, without where it shows nothing.
MatchPicture modelPicture(const ModelView& view);

/// Finds the view's pixels again in the live image of the measured frame, by their looks in
/// `picture`: modelPicture(), or another image from the same place.
ModelMatches matchModel(const ModelView& view, const MatchPicture& picture,
                        const MatchPicture& live, const MeasuredFrame& frame,
                        FeatureMatcher& matcher);

}  // namespace softscope
