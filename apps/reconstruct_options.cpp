// apps/reconstruct_options.cpp: names for everything that a reconstruction may be told.
#include "apps/reconstruct_options.h"

#include <utility>
#include <vector>

#include "apps/depth_options.h"
#include "core/error.h"

namespace softscope {
namespace {

template <class Choice>
using Names = std::vector<std::pair<const char*, Choice>>;

const Names<NodeModel> kNodeModels{{"rigid", NodeModel::kRigid}, {"affine", NodeModel::kAffine}};
const Names<EdgeWeighting> kEdgeWeightings{{"uniform", EdgeWeighting::kUniform},
                                           {"distance", EdgeWeighting::kDistance}};
const Names<RobustLoss> kLosses{
    {"none", RobustLoss::kNone}, {"huber", RobustLoss::kHuber}, {"tukey", RobustLoss::kTukey}};
const Names<NodeTrust> kNodeTrusts{{"equal", NodeTrust::kEqual},
                                   {"warp-noise", NodeTrust::kWarpNoise},
                                   {"nearer", NodeTrust::kNearer},
                                   {"paper", NodeTrust::kPaper}};
const Names<Illumination> kIlluminations{{"none", Illumination::kNone},
                                         {"headlight", Illumination::kHeadlight}};

template <class Choice>
std::string nameOf(const Names<Choice>& names, Choice choice) {
  for (const auto& [name, value] : names)
    if (value == choice) return name;
  return {};
}

template <class Choice>
Choice choiceOf(const Names<Choice>& names, const std::string& key, const std::string& text) {
  std::string all;
  for (const auto& [name, value] : names) {
    if (text == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  throw OptionError(key + " is `" + text + "`, but must be one of " + all);
}

void bindTissue(SettingsBinder& binder, TissueMaskOptions& options) {
  const std::string at = "tissue.";
  binder.bind(at + "margin_px", options.margin_px, "pixels this near to a masked one are left out");
  binder.bind(at + "detect_instruments", options.detect_instruments,
              "by colour, beside mask files");
  auto& [min_brightness, max_saturation, grow_px] = options.highlights;
  binder.bind(at + "highlights.min_brightness", min_brightness, "of the brightest channel");
  binder.bind(at + "highlights.max_saturation", max_saturation, "of a colourless pixel");
  binder.bind(at + "highlights.grow_px", grow_px, "the halo around them goes too");
  InstrumentOptions& tool = options.instruments;
  binder.bind(at + "instruments.max_redness", tool.max_redness, "of an instrument, at most");
  binder.bind(at + "instruments.min_brightness", tool.min_brightness, "darker has no colour");
  binder.bind(at + "instruments.open_px", tool.open_px, "narrower than twice this is dropped");
  binder.bind(at + "instruments.close_px", tool.close_px, "narrower holes are filled");
  binder.bind(at + "instruments.min_area_share", tool.min_area_share, "of the picture");
  binder.bind(at + "instruments.max_border_gap_px", tool.max_border_gap_px,
              "they begin this near to the border");
  binder.bind(at + "instruments.grow_px", tool.grow_px, "their shadowed rim goes too");
}

void bindModelView(SettingsBinder& binder, ModelViewOptions& options) {
  auto& [point_spacing_mm, disc_spacings, min_disc_px, surface_depth_mm, gap_px] = options;
  const std::string at = "view.";
  binder.bind(at + "point_spacing_mm", point_spacing_mm, "of the model's points");
  binder.bind(at + "disc_spacings", disc_spacings, "radius of a point's disc, in spacings");
  binder.bind(at + "min_disc_px", min_disc_px, "least radius of a disc");
  binder.bind(at + "surface_depth_mm", surface_depth_mm,
              "points this far behind the front one belong to its surface");
  binder.bind(at + "gap_px", gap_px, "gaps up to this in a nearer surface are closed");
}

void bindMatcher(SettingsBinder& binder, MatcherOptions& options) {
  const std::string at = "matcher.";
  binder.bind(at + "method", options.method, "dense-surf, sift, dis-flow or surf-off");
  binder.bind(at + "reach", options.reach, "longest shift, share of the longer side");
  binder.bind(at + "search_radius_px", options.search_radius_px, "around the predicted shift");
  binder.bind(at + "coarse_spacing_px", options.coarse_spacing_px, "of a coarser level's matches");
  binder.bind(at + "max_ratio", options.max_ratio, "best distance over the best one elsewhere");
  binder.bind(at + "elsewhere_px", options.elsewhere_px, "nearer to the best isn't elsewhere");
  binder.bind(at + "mutual_px", options.mutual_px, "the match back ends this near");
  binder.bind(at + "spacing_px", options.spacing_px, "one match a square of this size");
  binder.bind(at + "darkest_gray", options.darkest_gray, "darker pixels are left out");
  binder.bind(at + "dark_margin_px", options.dark_margin_px, "and those this near to them");
  binder.bind(at + "sift_features", options.sift_features, "key points SIFT keeps a picture");
  auto& [grid_px, wavelet_px, cell_px, max_invalid_share, min_contrast_gray] = options.dense_surf;
  binder.bind(at + "dense_surf.grid_px", grid_px, "from one descriptor to the next");
  binder.bind(at + "dense_surf.wavelet_px", wavelet_px, "side of the Haar wavelets; even");
  binder.bind(at + "dense_surf.cell_px", cell_px, "side of one of its 4 x 4 cells");
  binder.bind(at + "dense_surf.max_invalid_share", max_invalid_share, "of ignored wavelets");
  binder.bind(at + "dense_surf.min_contrast_gray", min_contrast_gray, "less: nothing to match");
  auto& [method, radius_px, iterations, max_shift_px, min_similarity, max_sigma_px, floor_sigma_px,
         drift_px] = options.subpixel;
  binder.bind(at + "subpixel.method", method, "gauss-newton, parabola or none");
  binder.bind(at + "subpixel.radius_px", radius_px, "window is (2 r + 1)²");
  binder.bind(at + "subpixel.iterations", iterations, "at most");
  binder.bind(at + "subpixel.max_shift_px", max_shift_px, "from where it began");
  binder.bind(at + "subpixel.min_similarity", min_similarity, "correlation of both windows");
  binder.bind(at + "subpixel.max_sigma_px", max_sigma_px, "less certain matches are dropped");
  binder.bind(at + "subpixel.floor_sigma_px", floor_sigma_px, "error that no texture removes");
  binder.bind(at + "subpixel.drift_px", drift_px, "and where tissue no longer looks as at first");
  auto& [reach_px, agree_px, max_strain, min_share] = options.consistency;
  binder.bind(at + "consistency.reach_px", reach_px, "others this near are neighbours");
  binder.bind(at + "consistency.agree_px", agree_px, "neighbours agree to this");
  binder.bind(at + "consistency.max_strain", max_strain, "and to this share of their distance");
  binder.bind(at + "consistency.min_share", min_share, "of them must agree; 0: no test");
}

void bindComparison(SettingsBinder& binder, ReconstructionOptions& options) {
  binder.bind("matcher.last_picture", options.match_last_picture,
              "frame to frame, for comparison: match the last picture, not the model");
}

void bindPose(SettingsBinder& binder, ReconstructOptions& options) {
  const std::string at = "pose.";
  RansacOptions& pose = options.method.pose;
  binder.bind(at + "threshold_mm", pose.threshold_mm, "pairs farther off are outliers");
  binder.bind(at + "confidence", pose.confidence, "that one trial drew inliers only");
  binder.bind(at + "max_trials", pose.max_trials, "of RANSAC");
  binder.bind(at + "refits", pose.refits, "fits to all inliers");
  binder.bind(at + "min_inliers", pose.min_inliers, "fewer are no pose");
  binder.bind(at + "min_share", pose.min_share, "of the pairs that must be inliers");
  binder.bind(at + "min_spread_mm", pose.min_spread_mm, "of the inliers across their line");
  binder.bind(at + "seed", options.random_seed, "of RANSAC's choices");
  auto& [iterations, noise_px, disparity_noise_px, robust_scale, scope, significance] =
      options.method.refine_pose;
  binder.bind(at + "refine.iterations", iterations, "0: RANSAC's fit is the pose");
  binder.bind(at + "refine.noise_px", noise_px, "floor of what matches err by");
  binder.bind(at + "refine.disparity_noise_px", disparity_noise_px, "and of what disparity does");
  binder.bind(at + "refine.robust_scale", robust_scale, "of the median: what moves more is tissue");
  binder.bind(at + "scope", scope, "auto, or static or moving where that is known");
  binder.bind(at + "significance", significance, "probability to take a static scope for moving");
  binder.bind("lift.max_step_mm", options.method.lift.max_step_mm,
              "more between four pixels is a depth step");
}

void bindGraph(SettingsBinder& binder, ReconstructOptions& options) {
  const std::string at = "graph.";
  GraphOptions& graph = options.method.graph;
  binder.bind(at + "node_spacing_mm", graph.node_spacing_mm, "between nodes, along the surface");
  binder.bind(at + "cell_mm", graph.cell_mm, "gaps of less than this count as surface");
  binder.bind(at + "detour_ratio", graph.detour_ratio, "way along the surface over straight line");
  binder.bind(at + "edge_weighting", options.edge_weighting, "uniform or distance");
}

void bindDeform(SettingsBinder& binder, ReconstructOptions& options) {
  const std::string at = "deform.";
  DeformOptions& deform = options.method.deform;
  binder.bind(at + "node_model", options.node_model, "rigid or affine");
  binder.bind(at + "rotation_weight", deform.rotation_weight, "w_rot; affine nodes alone");
  binder.bind(at + "regularisation_weight", deform.regularisation_weight, "w_reg");
  binder.bind(at + "seen_stiffness", deform.seen_stiffness, "of it, where tissue is in sight");
  binder.bind(at + "rest_weight", deform.rest_weight, "w_rest: hidden tissue stays");
  binder.bind(at + "data_weight", deform.data_weight, "w_data");
  binder.bind(at + "correspondence_weight", deform.correspondence_weight, "w_corr");
  binder.bind(at + "use_correspondences", options.method.use_correspondences,
              "false: matches give the pose alone");
  binder.bind(at + "data_loss", options.data_loss, "none, huber or tukey");
  binder.bind(at + "data_scale_mm", deform.data_robust.scale_mm, "larger residuals are doubted");
  binder.bind(at + "correspondence_loss", options.correspondence_loss, "none, huber or tukey");
  binder.bind(at + "correspondence_scale_mm", deform.correspondence_robust.scale_mm,
              "larger residuals are doubted");
  auto& [max_distance_mm, max_angle_deg, reference_sigma_mm, max_reliability, max_points] =
      deform.association;
  binder.bind(at + "max_distance_mm", max_distance_mm, "epsilon_d");
  binder.bind(at + "max_angle_deg", max_angle_deg, "epsilon_n");
  binder.bind(at + "reference_sigma_mm", reference_sigma_mm, "depth this sure weighs 1");
  binder.bind(at + "max_reliability", max_reliability, "no depth weighs more");
  binder.bind(at + "max_points", max_points, "an even subset; 0: all points");
  auto& [max_iterations, iterations_per_association, max_rejections, initial_damping, min_damping,
         max_damping, step_tolerance_mm, cost_tolerance] = deform.solver;
  binder.bind(at + "max_iterations", max_iterations, "accepted steps");
  binder.bind(at + "iterations_per_association", iterations_per_association, "");
  binder.bind(at + "max_rejections", max_rejections, "in a row");
  binder.bind(at + "initial_damping", initial_damping, "of Levenberg-Marquardt");
  binder.bind(at + "min_damping", min_damping, "");
  binder.bind(at + "max_damping", max_damping, "");
  binder.bind(at + "step_tolerance_mm", step_tolerance_mm, "smaller steps end the search");
  binder.bind(at + "cost_tolerance", cost_tolerance, "smaller gains end the search");
}

void bindFusion(SettingsBinder& binder, ReconstructOptions& options) {
  const std::string at = "fusion.";
  FusionOptions& fusion = options.method.fusion;
  auto& [max_depth_mm, max_sigma_mm, edge_step, edge_radius_px, min_cosine] = fusion.pixels;
  binder.bind(at + "max_depth_mm", max_depth_mm, "larger depths are no depths");
  binder.bind(at + "max_sigma_mm", max_sigma_mm, "less sure depths are not heard");
  binder.bind(at + "edge_step", edge_step, "share of the depth that is a depth edge");
  binder.bind(at + "edge_radius_px", edge_radius_px, "pixels this near to it are not heard");
  binder.bind(at + "min_cosine", min_cosine, "more grazing surfaces are not heard");
  VisibilityOptions& visibility = fusion.visibility;
  binder.bind(at + "visible_distance_mm", visibility.max_distance_mm, "epsilon_d");
  binder.bind(at + "visible_angle_deg", visibility.max_angle_deg, "epsilon_n");
  binder.bind(at + "occlusion_mm", visibility.occlusion_mm, "this far behind is hidden");
  binder.bind(at + "occlusion_cell_px", visibility.occlusion_cell_px, "squares of this size");
  PointFusionOptions& points = fusion.points;
  binder.bind(at + "truncation_mm", points.truncation_mm, "tau");
  binder.bind(at + "soft_truncation", points.soft_truncation, "weights fall smoothly to 0");
  binder.bind(at + "max_weight", points.max_weight, "omega_max");
  binder.bind(at + "reference_sigma_mm", points.reference_sigma_mm, "depth this sure weighs 1");
  binder.bind(at + "max_measurement_weight", points.max_measurement_weight, "of one depth");
  binder.bind(at + "node_trust", options.node_trust, "equal, warp-noise, nearer or paper");
  binder.bind(at + "node_spacing_mm", points.node_spacing_mm, "epsilon of the paper");
  binder.bind(at + "warp_sigma_mm", points.warp_sigma_mm, "error of one warp away from nodes");
  binder.bind(at + "along_ray", points.along_ray, "points move along their ray alone");
  binder.bind(at + "contradiction_loss", points.contradiction_loss,
              "share of its weight that a point seen through loses");
  binder.bind(at + "follow_innovation", points.follow_innovation,
              "the model yields where frames differ from it by more than depth errs");
  binder.bind(at + "buried_mm", points.buried_mm, "points less than this behind the surface go");
  binder.bind(at + "confirmed_weight", points.confirmed_weight, "lighter points must be found");
  auto& [spacing_mm, insert_sigma_mm, band_mm, confirm] = fusion.insertion;
  binder.bind(at + "insert_spacing_mm", spacing_mm, "between new points");
  binder.bind(at + "insert_max_sigma_mm", insert_sigma_mm, "less sure depths make no points");
  binder.bind(at + "insert_band_mm", band_mm, "a model point this near explains a pixel");
  binder.bind(at + "insert_confirm", confirm, "two frames in a row must agree");
  binder.bind(at + "cell_mm", fusion.density.cell_mm, "one point a cell");
  binder.bind(at + "cell_angle_deg", fusion.density.max_angle_deg, "two sides stay two");
}

void bindColour(SettingsBinder& binder, ReconstructOptions& options) {
  const std::string at = "colour.";
  ColourOptions& colour = options.method.fusion.colour;
  binder.bind(at + "compensate_gain", colour.compensate_gain, "of the frame against the model");
  binder.bind(at + "illumination", options.illumination, "none, or headlight: lit by the scope");
  binder.bind(at + "reference_distance_mm", colour.reference_distance_mm, "of the headlight");
  binder.bind(at + "gamma", colour.gamma, "of the pictures' encoding");
  binder.bind(at + "max_weight", colour.max_weight, "new colours count 1 / (1 + this) at least");
  binder.bind(at + "anchor_weight", colour.anchor_weight,
              "the same of the brightness that matches hold on to");
  binder.bind(at + "highlight_level", colour.highlight_level, "brighter is specular");
  binder.bind(at + "brightening_limit", colour.brightening_limit, "so much brighter is too");
}

void bindGate(SettingsBinder& binder, GateOptions& options) {
  auto& [min_coverage, max_residual_mm, min_explained, min_confidence, max_key_views,
         key_view_step_mm, key_view_step_deg] = options;
  const std::string at = "gate.";
  binder.bind(at + "min_coverage", min_coverage, "share of the tissue that has depth");
  binder.bind(at + "max_residual_mm", max_residual_mm, "of the warped model from the depth");
  binder.bind(at + "min_explained", min_explained, "share of the points in sight");
  binder.bind(at + "min_confidence", min_confidence, "of the evidence for pose and warp");
  binder.bind(at + "max_key_views", max_key_views, "kept to find the model again");
  binder.bind(at + "key_view_step_mm", key_view_step_mm, "between key views");
  binder.bind(at + "key_view_step_deg", key_view_step_deg, "between key views");
}

ReconstructionOptions methodOf(const std::string& preset) {
  if (preset == "paper") return ReconstructionOptions::paper();
  if (preset == "default") return {};
  throw OptionError("--preset is `" + preset + "`, but must be default or paper");
}

}  // namespace

ReconstructOptions::ReconstructOptions(const std::string& preset)
    : method(methodOf(preset)),
      random_seed(static_cast<int>(method.pose.seed)),
      node_model(nameOf(kNodeModels, method.deform.node_model)),
      edge_weighting(nameOf(kEdgeWeightings, method.graph.edge_weighting)),
      data_loss(nameOf(kLosses, method.deform.data_robust.loss)),
      correspondence_loss(nameOf(kLosses, method.deform.correspondence_robust.loss)),
      node_trust(nameOf(kNodeTrusts, method.fusion.points.node_trust)),
      illumination(nameOf(kIlluminations, method.fusion.colour.illumination)) {}

void ReconstructOptions::resolve() {
  require(random_seed >= 0, "pose.seed", random_seed, "can't be negative");
  method.pose.seed = static_cast<std::uint32_t>(random_seed);
  method.deform.node_model = choiceOf(kNodeModels, "deform.node_model", node_model);
  method.graph.edge_weighting = choiceOf(kEdgeWeightings, "graph.edge_weighting", edge_weighting);
  method.deform.data_robust.loss = choiceOf(kLosses, "deform.data_loss", data_loss);
  method.deform.correspondence_robust.loss =
      choiceOf(kLosses, "deform.correspondence_loss", correspondence_loss);
  method.fusion.points.node_trust = choiceOf(kNodeTrusts, "fusion.node_trust", node_trust);
  method.fusion.colour.illumination = choiceOf(kIlluminations, "colour.illumination", illumination);
  method.validate();
  sequence.validate();
}

void bindReconstructOptions(SettingsBinder& binder, ReconstructOptions& options) {
  bindFrameDepthOptions(binder, options.method.depth);
  bindSequenceOptions(binder, options.sequence);
  bindTissue(binder, options.method.tissue);
  bindModelView(binder, options.method.model_view);
  bindMatcher(binder, options.method.matcher);
  bindComparison(binder, options.method);
  bindPose(binder, options);
  bindGraph(binder, options);
  bindDeform(binder, options);
  bindFusion(binder, options);
  bindColour(binder, options);
  bindGate(binder, options.method.gate);
}

}  // namespace softscope
