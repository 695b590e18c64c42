// python/bind_reconstruction.cpp: model, run, reconstructor, settings.
#include "python/arrays.h"
#include "python/bindings.h"

namespace softscope::python {
namespace {

api::FrameReport process(api::Reconstructor& self, const Bytes& left, const Bytes& right,
                         const std::optional<Bytes>& mask, double time_s) {
  api::FrameView frame = frameOf(left, right, mask);
  frame.time_s = time_s;
  const py::gil_scoped_release released;
  return self.process(frame);
}

/// Reports of the frames of a sequence; both arguments must outlive it.
struct FrameReports {
  api::Reconstructor* reconstructor;
  api::Sequence* sequence;

  api::FrameReport next() const {
    std::optional<api::FrameReport> report;
    {
      const py::gil_scoped_release released;
      report = reconstructor->process(*sequence);
    }
    if (!report) throw py::stop_iteration();
    return std::move(*report);
  }
};

std::vector<api::SettingDescription> settingsOf(const std::string& command) {
  if (command == "reconstruct") return api::reconstructionSettings();
  if (command == "depth") return api::depthSettings();
  if (command == "simulate") return api::simulationSettings();
  throw OptionError("command is `" + command + "`, but must be reconstruct, depth or simulate");
}

}  // namespace

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
          "N, float32: how often, and how well, each point was seen.")
      .def_property_readonly(
          "sigmas_mm",
          [](const py::object& self) {
            const auto& model = self.cast<api::Model&>();
            return arrayOver(model.sigmas_mm, {py::ssize_t(model.sigmas_mm.size())}, self);
          },
          "N, float32: predicted standard errors, mm; NaN where unknown, empty of a run without.");

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

void bindFrameReports(py::module_& module) {
  py::class_<api::FrameReport>(module, "FrameReport", "What became of one frame.")
      .def_readonly("frame", &api::FrameReport::frame)
      .def_readonly("status", &api::FrameReport::status)
      .def_readonly("reason", &api::FrameReport::reason)
      .def_readonly("fused", &api::FrameReport::fused)
      .def_property_readonly(
          "world_from_left",
          [](const api::FrameReport& self) { return poseArray(self.world_from_left); },
          "4 x 4, float64, mm.")
      .def_readonly("map", &api::FrameReport::map,
                    "In whose world the pose is: 0 for the first model, another number for that of "
                    "another place.")
      .def_property_readonly(
          "joined_map",
          [](const api::FrameReport& self) {
            return self.joined_map < 0 ? std::nullopt : std::optional<int>(self.joined_map);
          },
          "Map that is part of `map` from this frame on; None: none.")
      .def_property_readonly(
          "world_from_joined",
          [](const api::FrameReport& self) { return poseArray(self.world_from_joined); },
          "4 x 4, float64, mm: its motion into `map`.")
      .def_readonly("coverage", &api::FrameReport::coverage)
      .def_readonly("confidence", &api::FrameReport::confidence,
                    "0 to 1; nan if neither the first fused frame nor compared with the model.")
      .def_readonly("matches", &api::FrameReport::matches)
      .def_readonly("points", &api::FrameReport::points)
      .def_readonly("elapsed_ms", &api::FrameReport::elapsed_ms)
      .def("__repr__", [](const api::FrameReport& self) {
        return "<softscope.FrameReport " + std::to_string(self.frame) + ": " + self.status + ">";
      });

  py::class_<FrameReports>(module, "FrameReports",
                           "Reports of the frames of a sequence, in their order. A frame is "
                           "processed when its report is asked for.")
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &FrameReports::next);
}

void bindReconstructor(py::module_& module) {
  py::class_<api::Reconstructor>(module, "Reconstructor",
                                 "Stereo frames to a live, deforming model.")
      .def(py::init([](const api::Calibration& calibration, const py::dict& settings,
                       const std::string& backend, const py::kwargs& keywords) {
             return std::make_unique<api::Reconstructor>(
                 calibration, reconstructionOptionsOf(settings, keywords), backend);
           }),
           "calibration"_a, "settings"_a = py::dict(), "backend"_a = "auto",
           "backend: auto, cpu or cuda. What differs from the defaults: by keyword, "
           "stereo_method='sgbm', or by key, settings={'stereo.method': 'sgbm'}; settings() lists "
           "the keys.")
      .def("record_to", &api::Reconstructor::recordTo, "folder"_a, "save_every"_a = 10,
           "overwrite"_a = false, "Before the first frame: writes a run folder meanwhile.")
      .def(
          "process",
          [](api::Reconstructor& self, api::Sequence& sequence) {
            return FrameReports{&self, &sequence};
          },
          "sequence"_a, py::keep_alive<0, 1>(), py::keep_alive<0, 2>(),
          "for report in process(sequence): the frames from the sequence's next one on, in the "
          "time of `softscope reconstruct`: the depth of the next frames is measured ahead. An "
          "unreadable frame has a report with the reason. The loop may be left after any frame "
          "and continued with process(). InputError: images of another size than the "
          "calibration's, or deleted; OptionError: a frame of this index or a later one was "
          "processed before.")
      .def("process", &process, "left"_a, "right"_a, "mask"_a = py::none(),
           "time_s"_a = std::numeric_limits<double>::quiet_NaN(),
           "One pair without a Sequence. left, right: height x width x 3 (RGB) or height x width, "
           "uint8; mask: height x width, uint8, not 0: ignored pixel. Arrays that are contiguous "
           "are not copied by Python.")
      .def("model", &api::Reconstructor::model, Released(), "A copy of the model as it is now.")
      .def("finish", &api::Reconstructor::finish, Released(),
           "Completes the folder of record_to() and returns it as a Run.");

  module.def(
      "settings",
      [](const std::string& command) {
        py::dict all;
        for (const api::SettingDescription& s : settingsOf(command))
          all[py::str(s.key)] = py::dict("type"_a = s.type, "unit"_a = s.unit, "range"_a = s.range,
                                         "default"_a = s.default_text, "meaning"_a = s.meaning);
        return all;
      },
      "command"_a = "reconstruct",
      "Every setting by its key; command: reconstruct (of Reconstructor), depth (of "
      "DepthEstimator) or simulate.");
}

}  // namespace softscope::python
