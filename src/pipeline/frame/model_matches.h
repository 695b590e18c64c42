// src/pipeline/frame/model_matches.h: stages 2 to 4: from model view and live image to point pairs.
#pragma once

#include <vector>

#include "features/lift_matches.h"
#include "features/matcher.h"
#include "pipeline/frame/frame_depth.h"
#include "pipeline/options/reconstruction_options.h"
#include "pose/rigid_fit.h"

namespace softscope {

/// What of a frame is no tissue: its mask with a margin, and its border. Of the size of `left`, the
/// rectified image.
Mask notTissue(const ColourImage& left, const MeasuredFrame& frame,
               const TissueMaskOptions& options);

/// The rectified left image as it is matched: without what is no tissue, without highlights.
MatchPicture livePicture(const ColourImage& left, const Mask& not_tissue);

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

/// From the live camera's frame to the world, weighted by their inverse variances.
PointPairs posePairs(const std::vector<LiftedMatch>& matches);

}  // namespace softscope
