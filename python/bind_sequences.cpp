// python/bind_sequences.cpp: bindings of calibration, frames, sequence, depth.
#include "python/arrays.h"
#include "python/bindings.h"

namespace softscope::python {
namespace {

api::Depth measure(api::DepthEstimator& self, const Bytes& left, const Bytes& right,
                   const std::optional<Bytes>& mask) {
  const api::FrameView frame = frameOf(left, right, mask);
  const py::gil_scoped_release released;
  return self.measure(frame);
}

/// Opens without Python's lock. `paths`: arguments of Sequence.
template <class... Paths>
std::unique_ptr<api::Sequence> open(const py::dict& settings, const py::kwargs& keywords,
                                    const Paths&... paths) {
  const api::Options options = reconstructionOptionsOf(settings, keywords);
  const py::gil_scoped_release released;
  return std::make_unique<api::Sequence>(paths..., options);
}

/// Raster over the memory of `self`, height x width, or x 3.
template <std::vector<float> api::Depth::*Values>
py::array_t<float> rasterOf(const py::object& self) {
  const auto& depth = self.cast<api::Depth&>();
  const std::vector<float>& values = depth.*Values;
  std::vector<py::ssize_t> shape{depth.height_px, depth.width_px};
  if (values.size() > std::size_t(depth.width_px) * std::size_t(depth.height_px))
    shape.push_back(3);
  return arrayOver(values, shape, self);
}

}  // namespace

void bindFrames(py::module_& module) {
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
}

void bindSequences(py::module_& module) {
  py::class_<api::Sequence>(module, "Sequence", "A stereo sequence on disk, frame by frame.")
      .def(py::init([](const std::string& folder, const py::dict& settings,
                       const py::kwargs& keywords) { return open(settings, keywords, folder); }),
           "folder"_a, "settings"_a = py::dict(),
           "Settings as for Reconstructor: those of the sequence and stereo.disparity_max_px are "
           "used.")
      .def(py::init([](const std::string& left, const std::string& right,
                       const std::string& calibration, const py::dict& settings,
                       const py::kwargs& keywords) {
             return open(settings, keywords, left, right, calibration);
           }),
           "left"_a, "right"_a, "calibration"_a, "settings"_a = py::dict(),
           "Two image folders or videos with their calibration.")
      .def_property_readonly("calibration", &api::Sequence::calibration)
      .def_property_readonly("warnings", &api::Sequence::warnings)
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

void bindDepth(py::module_& module) {
  py::class_<api::Depth>(module, "Depth", "Rasters of the rectified left camera; NaN: unmeasured.")
      .def_property_readonly("depth_mm", &rasterOf<&api::Depth::depth_mm>,
                             "height x width, float32: along the optical axis.")
      .def_property_readonly("sigma_mm", &rasterOf<&api::Depth::sigma_mm>,
                             "height x width, float32: predicted standard error.")
      .def_property_readonly("normals", &rasterOf<&api::Depth::normals>,
                             "height x width x 3, float32: towards the camera.")
      .def_property_readonly(
          "left",
          [](const py::object& self) { return arrayOf(self.cast<api::Depth&>().left, self); },
          "height x width x 3, uint8, RGB: the rectified left image.")
      .def_readonly("focal_px", &api::Depth::focal_px)
      .def_readonly("centre_u_px", &api::Depth::centre_u_px)
      .def_readonly("centre_v_px", &api::Depth::centre_v_px)
      .def_readonly("baseline_mm", &api::Depth::baseline_mm)
      .def_readonly("coverage", &api::Depth::coverage)
      .def_readonly("method", &api::Depth::method);
  py::class_<api::DepthEstimator>(module, "DepthEstimator", "One stereo pair to depth.")
      .def(py::init([](const api::Calibration& calibration, const py::dict& settings,
                       const std::string& backend, const py::kwargs& keywords) {
             const auto texts = settingTexts(settings, keywords, api::depthSettings());
             return std::make_unique<api::DepthEstimator>(calibration, optionsOf(texts), backend);
           }),
           "calibration"_a, "settings"_a = py::dict(), "backend"_a = "cpu",
           "Settings as for Reconstructor, of settings('depth').")
      .def("measure", &measure, "left"_a, "right"_a, "mask"_a = py::none(),
           "Images as for Reconstructor.process().");
}

}  // namespace softscope::python
