// tests/consumer/project/main.cpp: a program that uses the installed library.
#include <softscope/softscope.h>

#include <iostream>

int main(int, char** words) {
  using namespace softscope::api;
  SimulationRequest request;
  request.settings = {{"frames", "3"}, {"truth_every", "1"}};
  request.width_px = 240;
  request.height_px = 180;
  const std::string folder = words[1];
  simulate(folder + "/clip", request);
  Sequence sequence(folder + "/clip");
  Reconstructor reconstructor(sequence.calibration());
  reconstructor.recordTo(folder + "/run", /*save_every=*/1);
  while (const auto report = reconstructor.process(sequence))
    std::cout << report->frame << " " << report->status << "\n";
  const Evaluation evaluation = evaluate(reconstructor.finish(), folder + "/clip");
  std::cout << "P95 " << evaluation.surface.observed.p95_mm << " mm\n";
  try {
    Run(folder + "/none");
  } catch (const softscope::InputError&) {
    return evaluation.surface.observed.p95_mm < 1 ? 0 : 1;
  }
  return 2;  // an exception of the library must be caught by its name
}
