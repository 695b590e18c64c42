// python/bindings.cpp: the public face for Python; lengths are mm, images are NumPy arrays.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "softscope/softscope.h"

namespace softscope::python {
namespace {

namespace py = pybind11;
using namespace py::literals;
using Bytes = py::array_t<std::uint8_t, py::array::c_style>;
using Released = py::call_guard<py::gil_scoped_release>;

/// The array's own memory where it lies row by row; else a copy, which `array` then holds.
api::ImageView viewOf(const Bytes& array, const char* what) {
  if (array.size() == 0) return {};
  const bool grey = array.ndim() == 2;
  if (!grey && array.ndim() != 3)
    throw InputError(std::string(what) + ": has " + std::to_string(array.ndim()) +
                     " dimensions; give height x width or height x width x 3, uint8");
  return {array.data(), static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0)),
          grey ? 1 : static_cast<int>(array.shape(2))};
}

/// An array over memory that `owner` keeps alive.
template <class Value>
py::array_t<Value> arrayOver(const std::vector<Value>& values, std::vector<py::ssize_t> shape,
                             const py::object& owner) {
  return py::array_t<Value>(std::move(shape), values.data(), owner);
}

py::object arrayOf(const api::Image& image, const py::object& owner) {
  if (image.values.empty()) return py::none();
  std::vector<py::ssize_t> shape{image.height_px, image.width_px};
  if (image.channels > 1) shape.push_back(image.channels);
  return arrayOver(image.values, shape, owner);
}

py::array_t<double> poseArray(const api::Pose& pose) {
  return py::array_t<double>({4, 4}, pose.data());
}

py::array_t<double> poseArrays(const std::vector<api::Pose>& poses) {
  py::array_t<double> all({static_cast<py::ssize_t>(poses.size()), py::ssize_t(4), py::ssize_t(4)});
  for (std::size_t i = 0; i < poses.size(); ++i)
    std::copy(poses[i].begin(), poses[i].end(), all.mutable_data() + 16 * i);
  return all;
}

api::FrameReport process(api::Reconstructor& self, const Bytes& left, const Bytes& right,
                         const std::optional<Bytes>& mask, double time_s) {
  api::FrameView frame;
  frame.left = viewOf(left, "left");
  frame.right = viewOf(right, "right");
  if (mask) frame.mask = viewOf(*mask, "mask");
  frame.time_s = time_s;
  const py::gil_scoped_release released;
  return self.process(frame);
}

/// True, 3 and "sgbm" as a settings file writes them.
std::map<std::string, std::string> settingTexts(const py::dict& settings) {
  std::map<std::string, std::string> texts;
  for (const auto& [key, value] : settings) {
    const bool is_bool = py::isinstance<py::bool_>(value);
    texts[py::str(key)] = is_bool ? (value.cast<bool>() ? "true" : "false") : py::str(value);
  }
  return texts;
}

api::Options optionsOf(const py::dict& settings) {
  api::Options options;
  for (const auto& [key, value] : settingTexts(settings)) options.set(key, value);
  return options;
}

/// Between two parts of long work Python gets the lock: for `progress`, and for Ctrl-C.
/// Copies of the callback hold no reference, as those need the lock: `progress` must outlive them.
std::function<bool(int, int)> progressOf(const std::optional<py::function>& progress) {
  return [&progress](int done, int total) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress) return true;
    const py::object answer = (*progress)(done, total);
    return answer.is_none() || answer.cast<bool>();
  };
}

void bindErrors(py::module_& module) {
  const py::object error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<OptionError>(module, "OptionError", error);
  py::register_exception<InputError>(module, "InputError", error);
  py::register_exception<BackendError>(module, "BackendError", error);
}

void bindSequences(py::module_& module) {
  py::class_<api::Calibration>(module, "Calibration", "Two cameras on one scope; lengths in mm.")
      .def_static("read", &api::Calibration::read, "file"_a, "width_px"_a = 0, "height_px"_a = 0,
                  "From a calibration file; the size of the images where the file lacks it.")
      .def_static("rectified", &api::Calibration::rectified, "width_px"_a, "height_px"_a,
                  "focal_px"_a, "centre_u_px"_a, "centre_v_px"_a, "baseline_mm"_a,
                  "Two equal cameras without distortion whose rows are aligned.")
      .def_property_readonly("width_px", &api::Calibration::widthPx)
      .def_property_readonly("height_px", &api::Calibration::heightPx)
      .def_property_readonly("baseline_mm", &api::Calibration::baselineMm)
      .def_property_readonly("warnings", &api::Calibration::warnings);

  py::class_<api::Frame>(module, "Frame", "One frame of a sequence.")
      .def_readonly("index", &api::Frame::index)
      .def_readonly("time_s", &api::Frame::time_s, "NaN where the sequence has no clock.")
      .def_readonly("error", &api::Frame::error, "Why it could not be read; empty where it was.")
      .def_property_readonly(
          "left",
          [](const py::object& self) { return arrayOf(self.cast<api::Frame&>().left, self); },
          "height x width x 3, uint8, RGB; a view without a copy.")
      .def_property_readonly(
          "right",
          [](const py::object& self) { return arrayOf(self.cast<api::Frame&>().right, self); },
          "As left.")
      .def_property_readonly(
          "mask",
          [](const py::object& self) { return arrayOf(self.cast<api::Frame&>().mask, self); },
          "height x width, uint8, not 0: ignored pixel; None where there is none.");

  py::class_<api::Sequence>(module, "Sequence", "A stereo sequence on disk, frame by frame.")
      .def(py::init<const std::string&>(), "folder"_a, Released())
      .def(py::init<const std::string&, const std::string&, const std::string&>(), "left"_a,
           "right"_a, "calibration"_a, Released())
      .def_property_readonly("calibration", &api::Sequence::calibration)
      .def("__len__", &api::Sequence::frameCount)
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", [](api::Sequence& self) {
        std::optional<api::Frame> frame;
        {
          const py::gil_scoped_release released;
          frame = self.next();
        }
        if (!frame) throw py::stop_iteration();
        return std::move(*frame);
      });
}

void bindRuns(py::module_& module) {
  py::class_<api::Model>(module, "Model", "N points in the frame of the first left camera.")
      .def("__len__", &api::Model::size)
      .def_property_readonly(
          "points_mm",
          [](const py::object& self) {
            const auto& model = self.cast<api::Model&>();
            return arrayOver(model.points_mm, {py::ssize_t(model.points_mm.size() / 3), 3}, self);
          },
          "N x 3, float32, mm; a view without a copy.")
      .def_property_readonly(
          "normals",
          [](const py::object& self) {
            const auto& model = self.cast<api::Model&>();
            return arrayOver(model.normals, {py::ssize_t(model.normals.size() / 3), 3}, self);
          },
          "N x 3, float32, unit length, out of the tissue.")
      .def_property_readonly(
          "colours",
          [](const py::object& self) {
            const auto& model = self.cast<api::Model&>();
            return arrayOver(model.colours, {py::ssize_t(model.colours.size() / 3), 3}, self);
          },
          "N x 3, uint8, RGB.")
      .def_property_readonly(
          "weights",
          [](const py::object& self) {
            const auto& model = self.cast<api::Model&>();
            return arrayOver(model.weights, {py::ssize_t(model.weights.size())}, self);
          },
          "N, float32: how often, and how well, each point was seen.");

  py::class_<api::Run>(module, "Run", "The folder that a reconstruction leaves.")
      .def(py::init<std::string>(), "folder"_a, Released())
      .def_property_readonly("folder", &api::Run::folder)
      .def_property_readonly("frames", &api::Run::frames, "Frames with a pose, rising.")
      .def_property_readonly(
          "poses", [](const api::Run& self) { return poseArrays(self.poses()); },
          "F x 4 x 4, float64: world_from_left of each frame, mm.")
      .def_property_readonly("saved_models", &api::Run::savedModels)
      .def("model", py::overload_cast<>(&api::Run::model, py::const_), Released(),
           "The last model.")
      .def("model", py::overload_cast<int>(&api::Run::model, py::const_), "frame"_a, Released(),
           "The model that was saved at this frame.");
}

void bindReconstructor(py::module_& module) {
  py::class_<api::FrameReport>(module, "FrameReport", "What became of one frame.")
      .def_readonly("frame", &api::FrameReport::frame)
      .def_readonly("status", &api::FrameReport::status)
      .def_readonly("reason", &api::FrameReport::reason)
      .def_readonly("fused", &api::FrameReport::fused)
      .def_property_readonly(
          "world_from_left",
          [](const api::FrameReport& self) { return poseArray(self.world_from_left); },
          "4 x 4, float64, mm.")
      .def_readonly("coverage", &api::FrameReport::coverage)
      .def_readonly("matches", &api::FrameReport::matches)
      .def_readonly("points", &api::FrameReport::points)
      .def_readonly("elapsed_ms", &api::FrameReport::elapsed_ms)
      .def("__repr__", [](const api::FrameReport& self) {
        return "<softscope.FrameReport " + std::to_string(self.frame) + ": " + self.status + ">";
      });

  py::class_<api::Reconstructor>(module, "Reconstructor",
                                 "Stereo frames to a live, deforming model.")
      .def(py::init([](const api::Calibration& calibration, const py::dict& settings,
                       const std::string& backend) {
             return std::make_unique<api::Reconstructor>(calibration, optionsOf(settings), backend);
           }),
           "calibration"_a, "settings"_a = py::dict(), "backend"_a = "auto",
           "backend: auto, cpu or cuda; settings: what differs from the defaults, e.g. "
           "{'stereo.method': 'sgbm'}; settings() "
           "lists the keys.")
      .def("record_to", &api::Reconstructor::recordTo, "folder"_a, "save_every"_a = 10,
           "overwrite"_a = false, "Before the first frame: writes a run folder meanwhile.")
      .def("process", &process, "left"_a, "right"_a, "mask"_a = py::none(),
           "time_s"_a = std::numeric_limits<double>::quiet_NaN(),
           "left, right: height x width x 3 (RGB) or height x width, uint8; mask: height x width, "
           "uint8, not 0: ignored pixel. Arrays that are contiguous are not copied by Python.")
      .def("model", &api::Reconstructor::model, Released(), "A copy of the model as it is now.")
      .def("finish", &api::Reconstructor::finish, Released(),
           "Completes the folder of record_to() and returns it as a Run.");

  module.def(
      "settings",
      [] {
        py::dict all;
        for (const api::SettingDescription& s : api::reconstructionSettings())
          all[py::str(s.key)] = py::dict("type"_a = s.type, "unit"_a = s.unit, "range"_a = s.range,
                                         "default"_a = s.default_text, "meaning"_a = s.meaning);
        return all;
      },
      "Every setting of a reconstruction by its key.");
}

void bindJudges(py::module_& module) {
  py::class_<api::Distances>(module, "Distances", "mm; NaN where nothing was measured.")
      .def_readonly("mean_mm", &api::Distances::mean_mm)
      .def_readonly("sd_mm", &api::Distances::sd_mm)
      .def_readonly("rmse_mm", &api::Distances::rmse_mm)
      .def_readonly("median_mm", &api::Distances::median_mm)
      .def_readonly("p95_mm", &api::Distances::p95_mm)
      .def_readonly("max_mm", &api::Distances::max_mm)
      .def_readonly("count", &api::Distances::count);
  py::class_<api::SurfaceErrors>(module, "SurfaceErrors")
      .def_readonly("all", &api::SurfaceErrors::all)
      .def_readonly("observed", &api::SurfaceErrors::observed, "Points that the scope sees.")
      .def_readonly("predicted", &api::SurfaceErrors::predicted, "Points that it does not see.");
  py::class_<api::Evaluation>(module, "Evaluation")
      .def_readonly("surface", &api::Evaluation::surface)
      .def_readonly("metrics", &api::Evaluation::metrics, "By path; NaN: not measured.")
      .def_readonly("warnings", &api::Evaluation::warnings)
      .def_readonly("json", &api::Evaluation::record, "As in evaluation.json.")
      .def("metric", &api::Evaluation::metric, "path"_a);
  module.def(
      "evaluate",
      [](const api::Run& run, const std::string& reference, const std::string& align,
         bool each_model, double reference_unit_mm, bool views, const std::string& out,
         bool overwrite, const std::optional<py::function>& progress) {
        const api::EvaluationOptions options{align, each_model, reference_unit_mm,   views,
                                             out,   overwrite,  progressOf(progress)};
        const py::gil_scoped_release released;
        return api::evaluate(run, reference, options);
      },
      "run"_a, "reference"_a, "align"_a = "none", "each_model"_a = false,
      "reference_unit_mm"_a = 1.0, "views"_a = true, "out"_a = "", "overwrite"_a = false,
      "progress"_a = py::none(),
      "A run against a sequence with ground truth, a mesh, or its own images. progress(done, "
      "total) "
      "may return False to stop.");

  py::class_<api::Comparison>(module, "Comparison")
      .def_readonly("accuracy", &api::Comparison::accuracy, "From the test to the reference.")
      .def_readonly("completeness", &api::Comparison::completeness,
                    "From the reference to the test.")
      .def_readonly("metrics", &api::Comparison::metrics)
      .def_readonly("warnings", &api::Comparison::warnings)
      .def_readonly("json", &api::Comparison::record, "As in comparison.json.");
  module.def(
      "compare",
      [](const std::string& reference, const std::string& test, const std::string& align,
         const std::string& landmarks, double reference_unit_mm, double test_unit_mm,
         const std::vector<double>& taus_mm) {
        const py::gil_scoped_release released;
        return api::compare(reference, test,
                            {align, landmarks, reference_unit_mm, test_unit_mm, taus_mm});
      },
      "reference"_a, "test"_a, "align"_a = "none", "landmarks"_a = "", "reference_unit_mm"_a = 1.0,
      "test_unit_mm"_a = 1.0, "taus_mm"_a = std::vector<double>{0.5, 1, 2},
      "A surface or points against a reference surface; files.");
}

void bindPages(py::module_& module) {
  module.def(
      "report",
      [](const std::vector<std::string>& cases, const std::string& html,
         const std::vector<std::string>& names, const std::string& title, const std::string& pdf,
         double limit_mm, int seed, bool with_paths, bool overwrite) {
        const py::gil_scoped_release released;
        return api::report(cases, html, {names, title, pdf, limit_mm, seed, with_paths, overwrite});
      },
      "cases"_a, "html"_a, "names"_a = std::vector<std::string>(), "title"_a = "", "pdf"_a = "",
      "limit_mm"_a = 0.0, "seed"_a = 1, "with_paths"_a = false, "overwrite"_a = false,
      "Folders of evaluate(out=...) to a page that opens in any browser. Returns warnings.");
  module.def(
      "figure",
      [](const std::vector<std::string>& files, const std::string& kind, const std::string& run,
         const std::string& ct, const std::string& reference, const std::string& test,
         const std::vector<std::string>& surfaces, const std::vector<std::string>& scans,
         const std::string& align, const std::string& landmarks, const std::string& errors,
         double range_mm, int frame, const std::string& style, double width_mm,
         double dots_per_inch, bool overwrite) {
        const py::gil_scoped_release released;
        return api::figure({kind, run, ct, reference, test, surfaces, scans, align, landmarks,
                            errors, range_mm, frame},
                           files, {style, width_mm, dots_per_inch}, overwrite);
      },
      "files"_a, "kind"_a = "four", "run"_a = "", "ct"_a = "", "reference"_a = "", "test"_a = "",
      "surfaces"_a = std::vector<std::string>(), "scans"_a = std::vector<std::string>(),
      "align"_a = "none", "landmarks"_a = "", "errors"_a = "absolute", "range_mm"_a = 0.0,
      "frame"_a = -1, "style"_a = "ieee", "width_mm"_a = 0.0, "dots_per_inch"_a = 0.0,
      "overwrite"_a = false,
      "A figure of a run beside its sequence, or of CT, reference and model, to .png, .pdf or "
      ".svg files. Returns warnings.");
}

void bindSimulation(py::module_& module) {
  py::class_<api::Simulation>(module, "Simulation")
      .def_readonly("folder", &api::Simulation::folder)
      .def_readonly("frames", &api::Simulation::frames)
      .def_readonly("tracked_points", &api::Simulation::tracked_points);
  module.def(
      "simulate",
      [](const std::string& folder, const py::dict& settings, int width_px, int height_px,
         bool overwrite, const std::optional<py::function>& progress) {
        const api::SimulationRequest request{settingTexts(settings), width_px, height_px, overwrite,
                                             progressOf(progress)};
        const py::gil_scoped_release released;
        return api::simulate(folder, request);
      },
      "folder"_a, "settings"_a = py::dict(), "width_px"_a = 640, "height_px"_a = 480,
      "overwrite"_a = false, "progress"_a = py::none(),
      "A stereo sequence with ground truth. settings: keys of a scenario, e.g. {'frames': 40, "
      "'seed': 3}.");
}

}  // namespace
}  // namespace softscope::python

PYBIND11_MODULE(softscope, module) {
  using namespace softscope::python;
  module.doc() = "Live, deforming tissue models from stereo endoscope images. Lengths are mm.";
  bindErrors(module);
  bindSequences(module);
  bindRuns(module);
  bindReconstructor(module);
  bindJudges(module);
  bindPages(module);
  bindSimulation(module);
}
