// vtk_views/viewer/view_controls.h: key bindings and playback state of the viewer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "vtk_views/viewer/view_source.h"

namespace softscope {

enum class ViewColour { kTexture, kErrors, kWeights };

/// Where the model is looked at from.
enum class Look {
  kFree,   // parallel, as figures have it
  kScope,  // with the scope's own eye, which moves
  kFront,  // axial with a CT, else as the scope at its first frame looked, from afar
  kAbove,  // coronal, or from above
  kRight,  // sagittal, or from the right
};

struct ViewState {
  ViewColour colour = ViewColour::kTexture;
  Look look = Look::kFree;
  bool nodes = false, motion = false, scope = true, ct = true, reference = true, help = false;
  double dot_scale = 1;
  bool turning = false;  // about the model, all the way round: nothing may leave the window
};

/// Goes through the moments by the clip's own clock.
class Playback {
 public:
  explicit Playback(const ViewSource& source) : source_(source) {}

  int index() const { return index_; }
  /// How much of the time until the next moment has passed: 0 at a moment itself, and at the last.
  double share() const;
  bool playing = false, looping = false;
  double speed = 1;  // seconds of the clip a second

  void goTo(int index);  // stops at the ends
  /// To a time of the clip, as while playing.
  void goToTime(double clip_s);
  void step(int by) {
    playing = false;
    goTo(index_ + by);
  }
  void togglePlaying();
  /// Some seconds have passed; whether another moment is to be shown.
  bool pass(double seconds);
  /// A live run has grown: shows its end if its end was shown.
  bool follow(int count_before);

 private:
  const ViewSource& source_;
  int index_ = 0;
  double at_s_ = 0;  // of the clip, while playing
};

/// When the last moment ends: it stays as long as the one before it.
double endSeconds(const ViewSource& source);

/// What is to be done after a key.
enum class ViewTask { kNothing, kRedraw, kLook, kScreenshot, kQuit };

/// Changes playback and state as the key (VTK's name of it) says.
ViewTask pressKey(const std::string& key, const ViewWorld& world, Playback& playback,
                  ViewState& state);

/// Keys and their meanings, in the order of help.
const std::vector<std::pair<std::string, std::string>>& viewKeys();

/// What there is to colour by; always the texture, first.
std::vector<ViewColour> coloursOf(const ViewWorld& world);

}  // namespace softscope
