// src/features/feature_settings.h: keys, ranges and meanings of the settings of masks, model view,
// matching and lifting.
#pragma once

#include "core/setting_rules.h"
#include "features/highlight_mask.h"
#include "features/instrument_detector.h"
#include "features/lift_matches.h"
#include "features/matcher_options.h"
#include "features/model_view.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, HighlightOptions& o) {
  v("tissue.highlights.min_brightness", o.min_brightness, between(1, 255),
    "least brightest channel of a specular highlight");
  v("tissue.highlights.max_saturation", o.max_saturation, between(0, 1),
    "largest (max - min) / max of the channels of a highlight");
  v("tissue.highlights.grow_px", o.grow_px, atLeast(0), "dilation of the highlight mask");
}

template <class Visitor>
void describe(Visitor& v, InstrumentOptions& o) {
  v("tissue.instruments.max_redness", o.max_redness, inside(-1, 1), "of an instrument, at most");
  v("tissue.instruments.min_brightness", o.min_brightness, between(0, 255),
    "darker pixels have no colour");
  v("tissue.instruments.open_px", o.open_px, atLeast(0), "candidates narrower than twice this go");
  v("tissue.instruments.close_px", o.close_px, atLeast(0), "holes narrower than twice this close");
  v("tissue.instruments.min_area_share", o.min_area_share, between(0, 1), "of the image");
  v("tissue.instruments.max_border_gap_px", o.max_border_gap_px, atLeast(0),
    "an instrument begins this near to the border");
  v("tissue.instruments.grow_px", o.grow_px, atLeast(0), "dilation of the instrument mask");
}

template <class Visitor>
void describe(Visitor& v, ModelViewOptions& o) {
  v("view.point_spacing_mm", o.point_spacing_mm, above(0), "of the model's points");
  v("view.disc_spacings", o.disc_spacings, above(0), "radius of a point's disc, in spacings");
  v("view.min_disc_px", o.min_disc_px, between(1, 12), "least radius of a disc");
  v("view.surface_depth_mm", o.surface_depth_mm, above(0),
    "points this far behind the front one belong to its surface");
  v("view.gap_px", o.gap_px, atLeast(0), "gaps up to this in a nearer surface are closed");
}

template <class Visitor>
void describe(Visitor& v, LiftOptions& o) {
  v("lift.max_step_mm", o.max_step_mm, above(0),
    "larger differences of four pixels are depth discontinuities");
}

template <class Visitor>
void describe(Visitor& v, DenseSurfOptions& o) {
  v("matcher.dense_surf.grid_px", o.grid_px, atLeast(1), "from one descriptor to the next");
  v("matcher.dense_surf.wavelet_px", o.wavelet_px, atLeast(2), "side of the Haar wavelets; even");
  v("matcher.dense_surf.cell_px", o.cell_px, atLeast(1),
    "side of one of the 4 x 4 cells; a multiple of grid_px");
  v("matcher.dense_surf.max_invalid_share", o.max_invalid_share, fromToBelow(0, 1),
    "largest share of ignored wavelets");
  v("matcher.dense_surf.min_contrast_gray", o.min_contrast_gray, atLeast(0),
    "descriptors with less contrast are not matched");
}

template <class Visitor>
void describe(Visitor& v, SubpixelOptions& o) {
  v("matcher.subpixel.method", o.method, oneOf({"gauss-newton", "parabola", "none"}),
    "sub-pixel refinement of matches");
  v("matcher.subpixel.radius_px", o.radius_px, between(1, 7), "the window is (2 r + 1)² pixels");
  v("matcher.subpixel.iterations", o.iterations, atLeast(1), "at most");
  v("matcher.subpixel.max_shift_px", o.max_shift_px, above(0), "largest distance from the start");
  v("matcher.subpixel.min_similarity", o.min_similarity, between(-1, 1),
    "least correlation of both windows");
  v("matcher.subpixel.max_sigma_px", o.max_sigma_px, above(0),
    "matches with a larger predicted sigma are dropped");
  v("matcher.subpixel.floor_sigma_px", o.floor_sigma_px, atLeast(0),
    "error that no texture removes");
  v("matcher.subpixel.drift_px", o.drift_px, atLeast(0),
    "error where tissue no longer looks as at first");
}

template <class Visitor>
void describe(Visitor& v, ConsistencyOptions& o) {
  v("matcher.consistency.reach_px", o.reach_px, above(0), "matches this near are neighbours");
  v("matcher.consistency.agree_px", o.agree_px, above(0),
    "largest difference of shifts that agree");
  v("matcher.consistency.max_strain", o.max_strain, fromToBelow(0, 1),
    "largest difference as a share of the distance");
  v("matcher.consistency.min_share", o.min_share, between(0, 1),
    "share of neighbours that must agree; 0: no test");
}

template <class Visitor>
void describe(Visitor& v, MatcherOptions& o) {
  v("matcher.method", o.method, oneOf({"dense-surf", "sift", "dis-flow", "surf-off"}),
    "matches of the model view in the left image; surf-off: none");
  v("matcher.reach", o.reach, aboveUpTo(0, 1), "longest shift, as a share of the longer side");
  v("matcher.search_radius_px", o.search_radius_px, above(0), "around the predicted shift");
  v("matcher.coarse_spacing_px", o.coarse_spacing_px, atLeast(1),
    "spacing of matches from a coarser level");
  v("matcher.max_ratio", o.max_ratio, aboveUpTo(0, 1),
    "Lowe ratio: best distance over the best one elsewhere");
  v("matcher.elsewhere_px", o.elsewhere_px, atLeast(0), "nearer to the best is not elsewhere");
  v("matcher.mutual_px", o.mutual_px, atLeast(0), "cross-check: the match back ends this near");
  v("matcher.spacing_px", o.spacing_px, atLeast(1), "one match in each square of this size");
  v("matcher.darkest_gray", o.darkest_gray, between(0, 255), "darker pixels are not matched");
  v("matcher.dark_margin_px", o.dark_margin_px, atLeast(0),
    "pixels this near to dark ones are not matched");
  v("matcher.sift_features", o.sift_features, atLeast(1), "key points of SIFT per image");
  describe(v, o.dense_surf);
  describe(v, o.subpixel);
  describe(v, o.consistency);
}

}  // namespace softscope
