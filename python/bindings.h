// python/bindings.h: parts of the module.
#pragma once

#include <pybind11/pybind11.h>

namespace softscope::python {

void bindFrames(pybind11::module_& module);
void bindSequences(pybind11::module_& module);
void bindDepth(pybind11::module_& module);
void bindRuns(pybind11::module_& module);
void bindFrameReports(pybind11::module_& module);
void bindReconstructor(pybind11::module_& module);
void bindJudges(pybind11::module_& module);
void bindPages(pybind11::module_& module);
void bindSimulation(pybind11::module_& module);

}  // namespace softscope::python
