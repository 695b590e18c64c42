// tests/cuda/survey_frame.h: surveys a frame as the back end does, ahead.
#pragma once

#include "fusion/frame_survey.h"

namespace softscope::test {

struct Surveyed {
  TissueDepths depths;
  Raster<PixelState> states;
};

inline Surveyed surveyFrame(const Observation& frame, const PixelOptions& options,
                            FrameSurvey* survey, const GrayImage& gray = {},
                            const Mask& ignore = {}) {
  const Mask tissue(frame.left.width_px, frame.left.height_px, 0);
  survey->show(frame.colour, frame.mask.empty() ? tissue : frame.mask, gray, ignore);
  Surveyed found;
  found.depths = survey->depthsOf(frame);
  found.states = survey->statesOf(frame, options);
  return found;
}

}  // namespace softscope::test
