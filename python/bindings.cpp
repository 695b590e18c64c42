// python/bindings.cpp: module `softscope`, the public interface in Python; lengths in mm.
#include "python/bindings.h"

#include <pybind11/pybind11.h>

#include "softscope/error.h"

namespace softscope::python {
namespace {

namespace py = pybind11;

void bindErrors(py::module_& module) {
  const py::object error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<OptionError>(module, "OptionError", error);
  py::register_exception<InputError>(module, "InputError", error);
  py::register_exception<BackendError>(module, "BackendError", error);
}

}  // namespace
}  // namespace softscope::python

PYBIND11_MODULE(softscope, module) {
  using namespace softscope::python;
  module.doc() = "Live, deforming tissue models from stereo endoscope images. Lengths are mm.";
  bindErrors(module);
  bindFrames(module);
  bindSequences(module);
  bindDepth(module);
  bindRuns(module);
  bindFrameReports(module);
  bindReconstructor(module);
  bindJudges(module);
  bindPages(module);
  bindSimulation(module);
}
