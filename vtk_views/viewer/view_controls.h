// vtk_views/viewer/view_controls.h: key bindings and playback state of the viewer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vtk_views/viewer/view_source.h"

namespace softscope {

enum class ViewColour { kTexture, kErrors, kWeights };

/// Viewpoint of the model.
enum class Look {
  kFree,   // parallel projection, as in figures
  kScope,  // moving camera of the scope
  kFront,  // axial with a CT, else in the initial direction of the scope, from afar
  kAbove,  // coronal, or from above
  kRight,  // sagittal, or from the right
};

struct ViewState {
  ViewColour colour = ViewColour::kTexture;
  Look look = Look::kFree;
  bool nodes = false, motion = false, scope = true, ct = true, reference = true, help = false;
  double dot_scale = 1;
  bool turning = false;  // full rotation about the model: it must stay inside the window
};

/// Playback in the time of the clip.
class Playback {
 public:
  explicit Playback(const ViewSource& source) : source_(source) {}

  int index() const { return index_; }
  /// Share of the time to the next model: 0 at a model, and at the last one.
  double share() const;
  bool playing = false, looping = false;
  double speed = 1;  // seconds of the clip per second

  void goTo(int index);  // limited to the range
  /// To a clip time, as during playback.
  void goToTime(double clip_s);
  void step(int by) {
    playing = false;
    goTo(index_ + by);
  }
  void togglePlaying();
  /// Advances by some seconds; true if another model must be shown.
  bool pass(double seconds);
  /// After new models of a live run: moves to the end if it was at the end.
  bool follow(int count_before);

 private:
  const ViewSource& source_;
  int index_ = 0;
  double at_s_ = 0;  // clip time during playback
};

/// End of the last model: it is shown as long as the one before.
double endSeconds(const ViewSource& source);

/// Action after a key.
enum class ViewTask { kNothing, kRedraw, kLook, kScreenshot, kQuit };

/// Changes playback and state according to the key (its name in VTK).
ViewTask pressKey(const std::string& key, const ViewWorld& world, Playback& playback,
                  ViewState& state);

/// Keys and their meanings, in the order of help.
const std::vector<std::pair<std::string, std::string>>& viewKeys();

/// Available colourings; texture is always first.
std::vector<ViewColour> coloursOf(const ViewWorld& world);

}  // namespace softscope
