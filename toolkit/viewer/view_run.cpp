// toolkit/viewer/view_run.cpp: models of a run, with a cache of the last ones.
#include "toolkit/viewer/view_run.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "eval/surfaces/surface_alignment.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"
#include "toolkit/run/model_file.h"
#include "toolkit/run/table_reader.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostKept = 12;    // models in the cache; 5 MB each with 100 000 points
constexpr double kFramesPerSecond = 25;  // of clips without timestamps
constexpr double kUsualWeight = 10;      // default limit of the weight

/// nodes/NNNNNN.csv next to models/; empty for runs that did not save them.
std::vector<Eigen::Vector3f> readNodes(const ModelOnDisk& model) {
  const fs::path file =
      model.file.parent_path().parent_path() / "nodes" / (model.file.stem().string() + ".csv");
  std::vector<Eigen::Vector3f> nodes;
  if (!fs::exists(file)) return nodes;
  const NumberTable table(readBytes(file), shown(file), {"node", "x_mm", "y_mm", "z_mm"}, {});
  for (std::size_t row = 0; row < table.rows(); ++row)
    nodes.push_back(table.placeAt(row, 1).cast<float>());
  return nodes;
}

std::vector<double> matrixNumbers(const std::string& bytes) {
  std::vector<double> numbers;
  const auto json = nlohmann::json::parse(bytes, nullptr, false);
  if (json.is_object()) {
    const auto alignments = json.find("alignments");
    if (alignments == json.end() || !alignments->is_array() || alignments->empty()) return {};
    const auto matrix = alignments->back().find("mesh_from_run");
    if (matrix == alignments->back().end()) return {};
    for (const auto& row : *matrix)
      for (const auto& value : row)
        if (value.is_number()) numbers.push_back(value);
    return numbers;
  }
  for (const std::string_view line : linesOf(bytes))
    for (const std::string_view word : wordsOf(line))
      if (const auto number = numberOf(word)) numbers.push_back(*number);
  return numbers;
}

Eigen::Vector3f moved(const Eigen::Isometry3d& motion, const Eigen::Vector3f& point_mm) {
  return (motion * point_mm.cast<double>()).cast<float>();
}

}  // namespace

Eigen::Isometry3d readMotion(const fs::path& file) {
  const std::vector<double> numbers = matrixNumbers(readBytes(file, kTextLimitBytes));
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  for (std::size_t i = 0; i < numbers.size() && i < 16; ++i)
    matrix(Eigen::Index(i / 4), Eigen::Index(i % 4)) = numbers[i];
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  const bool rigid = numbers.size() == 16 && matrix.allFinite() &&
                     (turn * turn.transpose()).isIdentity(1e-4) && turn.determinant() > 0 &&
                     matrix.row(3).isApprox(Eigen::RowVector4d(0, 0, 0, 1), 1e-6);
  if (!rigid)
    throw InputError(
        shown(file) +
        ": contains no rigid transform; give four rows of four numbers (mm), or the "
        "evaluation.json of softscope evaluate with a mesh as `reference=` and `align=` rigid");
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.matrix() = matrix;
  return motion;
}

RunSource::RunSource(const ViewRunOptions& options) : options_(options), run_(options.run) {
  models_ = findModelsOnDisk(run_, {});
  if (models_.empty())
    throw InputError(shown(run_) +
                     ": contains no model (models/NNNNNN.ply or model.ply); give a folder that "
                     "softscope reconstruct wrote, or `wait=` for the first one");
  describeModels();
  const ViewMoment last = read(count() - 1, false);  // the first model has no nodes
  world_.has_nodes = !last.nodes_mm.empty();
  world_.has_weights = !last.weights.empty();
  if (world_.has_weights)
    world_.largest_weight = std::max(
        kUsualWeight, roundUp(*std::max_element(last.weights.begin(), last.weights.end())));
  addVolume();
  addErrors();
}

/// Data derived from the list of models; repeated after new models.
void RunSource::describeModels() {
  live_ = !runHasEnded(run_);
  stopped_ = runHasStopped(run_);
  clock_ = false;
  for (const ModelOnDisk& model : models_) {
    clock_ |= model.time_s != model.frame;
    if (model.left.width_px > 0) world_.left = model.left;
  }
  world_.path_mm = live_ ? std::vector<std::pair<int, Eigen::Vector3f>>() : readScopePath(run_);
  if (world_.path_mm.empty())
    for (const ModelOnDisk& model : models_)
      if (model.world_from_left)
        world_.path_mm.emplace_back(model.frame,
                                    model.world_from_left->translation().cast<float>());
  for (auto& [frame, place] : world_.path_mm) place = moved(scene_from_run_, place);
}

void RunSource::addVolume() {
  if (!options_.ct_from_run.empty()) scene_from_run_ = readMotion(options_.ct_from_run);
  if (!options_.ct.empty()) {
    world_.volume = readVolume(options_.ct, options_.volume.options());
    world_.window = parseWindow(options_.window, *world_.volume);
    const bool known = world_.volume->facts.file_space != "unknown";
    world_.frame = known ? SceneFrame::kPatient : SceneFrame::kAxes;
    for (const std::string& warning : world_.volume->facts.warnings)
      warnings_.push_back(options_.ct + ": " + warning);
    SceneSurface model;
    model.mesh.vertices_mm = moment(0, false)->model.vertices_mm;
    if (!boxOf(*world_.volume).intersects(boxOf({model})))
      warnings_.push_back(options_.ct +
                          ": the model is outside of it; a run is in its camera frame, so give "
                          "`ct_from_run=` FILE, the transform into the CT");
  }
  kept_.clear();
  describeModels();
}

void RunSource::addErrors() {
  if (!options_.evaluation.empty()) errors_ = errorsFromEvaluation(options_.evaluation);
  if (!options_.reference.empty()) {
    reference_ = errorsFromReference(options_.reference, run_, scene_from_run_);
    for (const std::string& warning : reference_->warnings()) warnings_.push_back(warning);
  }
  if (!errors_ && !reference_) return;
  world_.has_errors = true;
  world_.has_reference = reference_ != nullptr;
  for (int index = count() - 1; index >= 0; --index) {
    const ViewMoment some = read(index, true);
    if (some.errors_mm.empty()) continue;
    return chooseErrorColours(some.errors_mm, options_.errors, world_);
  }
  warnings_.push_back(shown(run_) + ": the errors of all its frames are unknown");
}

double RunSource::secondsOf(int index) const {
  const ModelOnDisk& model = models_[std::size_t(index)];
  return clock_ ? model.time_s : model.frame / kFramesPerSecond;
}

void RunSource::addNodes(int index, ViewMoment& moment) const {
  moment.nodes_mm = readNodes(models_[std::size_t(index)]);
  if (index == 0 || moment.nodes_mm.empty()) return;
  const ModelOnDisk& before = models_[std::size_t(index - 1)];
  const std::vector<Eigen::Vector3f> were_mm = readNodes(before);  // nodes keep their numbers
  moment.moved_since = before.frame;
  for (std::size_t i = 0; i < std::min(were_mm.size(), moment.nodes_mm.size()); ++i)
    moment.node_motion_mm.push_back(moment.nodes_mm[i] - were_mm[i]);
}

void RunSource::moveToPatient(ViewMoment& moment) const {
  if (scene_from_run_.matrix().isIdentity(0)) return;
  for (auto* points : {&moment.model.vertices_mm, &moment.judged.vertices_mm, &moment.nodes_mm})
    *points = movePoints(scene_from_run_, *points);
  for (Eigen::Vector3f& motion : moment.node_motion_mm)
    motion = scene_from_run_.linear().cast<float>() * motion;
  if (moment.world_from_left) moment.world_from_left = scene_from_run_ * *moment.world_from_left;
  if (!moment.reference) return;
  if (moved_reference_.first != moment.reference) {
    TriangleMesh reference = *moment.reference;
    reference.vertices_mm = movePoints(scene_from_run_, reference.vertices_mm);
    moved_reference_ = {moment.reference,
                        std::make_shared<const TriangleMesh>(std::move(reference))};
  }
  moment.reference = moved_reference_.second;
}

ViewMoment RunSource::read(int index, bool with_errors) {
  const ModelOnDisk& saved = models_[std::size_t(index)];
  ModelFile file = readModel(saved.file);
  ViewMoment moment;
  moment.frame = saved.frame;
  if (clock_) moment.time_s = saved.time_s;
  moment.world_from_left = saved.world_from_left;
  moment.model.vertices_mm = std::move(file.model.positions_mm);
  if (file.coloured) moment.model.colours = std::move(file.model.colours);
  if (file.weighted) moment.weights = std::move(file.model.weights);
  addNodes(index, moment);
  if (reference_) moment.reference = reference_->reference(moment);
  MomentErrors* errors = errors_ ? errors_.get() : reference_.get();
  if (with_errors && errors != nullptr) errors->judge(options_.errors.kind == "signed", moment);
  moveToPatient(moment);
  return moment;
}

std::shared_ptr<const ViewMoment> RunSource::moment(int index, bool with_errors) {
  const int frame = frameOf(index);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return kept.frame == frame && (kept.with_errors || !with_errors);
  });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().moment;
  }
  kept_.push_front(
      {frame, with_errors, std::make_shared<const ViewMoment>(read(index, with_errors))});
  if (kept_.size() > kMostKept) kept_.pop_back();
  return kept_.front().moment;
}

void RunSource::look() {
  if (!live_) return;
  std::vector<ModelOnDisk> now = findModelsOnDisk(run_, models_);
  if (now.size() < models_.size())
    throw InputError(
        shown(run_) +
        ": models were deleted; was the run restarted? Open it again with softscope view");
  const bool grown = now.size() > models_.size(), ended = runHasEnded(run_);
  stopped_ = runHasStopped(run_);
  if (!grown && !ended) return;
  models_ = std::move(now);
  describeModels();
}

}  // namespace softscope
