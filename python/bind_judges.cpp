// python/bind_judges.cpp: bindings of evaluation, comparison, report, figure, simulation.
#include "python/arrays.h"
#include "python/bindings.h"

namespace softscope::python {

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
      "reference_unit_mm"_a = api::kStatedUnit, "views"_a = true, "out"_a = "",
      "overwrite"_a = false, "progress"_a = py::none(),
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
      "reference"_a, "test"_a, "align"_a = "none", "landmarks"_a = "",
      "reference_unit_mm"_a = api::kStatedUnit, "test_unit_mm"_a = api::kStatedUnit,
      "taus_mm"_a = std::vector<double>{0.5, 1, 2},
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
         bool overwrite, const std::optional<py::function>& progress, const py::kwargs& keywords) {
        const api::SimulationRequest request{
            settingTexts(settings, keywords, api::simulationSettings()), width_px, height_px,
            overwrite, progressOf(progress)};
        const py::gil_scoped_release released;
        return api::simulate(folder, request);
      },
      "folder"_a, "settings"_a = py::dict(), "width_px"_a = 640, "height_px"_a = 480,
      "overwrite"_a = false, "progress"_a = py::none(),
      "A stereo sequence with ground truth. Keys of a scenario as keywords, frames=40, "
      "push_amplitude_mm=3, or as settings={'push.amplitude_mm': 3}; settings('simulate') lists "
      "them.");
}

}  // namespace softscope::python
