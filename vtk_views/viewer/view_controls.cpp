// vtk_views/viewer/view_controls.cpp: table of keys, playback clock.
#include "vtk_views/viewer/view_controls.h"

#include <algorithm>
#include <functional>
#include <map>

namespace softscope {
namespace {

constexpr double kSlowest = 1.0 / 16, kFastest = 16, kSmallestDotPx = 0.25, kLargestDotPx = 8;
constexpr double kOnlyMoment_s = 1;

void nextColour(const ViewWorld& world, ViewState& state) {
  const std::vector<ViewColour> colours = coloursOf(world);
  const auto now = std::find(colours.begin(), colours.end(), state.colour);
  state.colour = now == colours.end() || now + 1 == colours.end() ? colours.front() : now[1];
}

void setColour(ViewColour colour, const ViewWorld& world, ViewState& state) {
  const std::vector<ViewColour> colours = coloursOf(world);
  if (std::find(colours.begin(), colours.end(), colour) != colours.end()) state.colour = colour;
}

struct Pressed {
  const ViewWorld& world;
  Playback& playback;
  ViewState& state;

  ViewTask toggle(bool& what) const {
    what = !what;
    return ViewTask::kRedraw;
  }
  ViewTask speed(double factor) const {
    playback.speed = std::clamp(playback.speed * factor, kSlowest, kFastest);
    return ViewTask::kRedraw;
  }
  ViewTask dots(double factor) const {
    state.dot_scale = std::clamp(state.dot_scale * factor, kSmallestDotPx, kLargestDotPx);
    return ViewTask::kRedraw;
  }
  ViewTask colour(ViewColour wanted) const {
    setColour(wanted, world, state);
    return ViewTask::kRedraw;
  }
  ViewTask look(Look wanted) const {
    state.look = wanted;
    return ViewTask::kLook;
  }
  ViewTask step(int by) const {
    playback.step(by);
    return ViewTask::kRedraw;
  }
};

using Keys = std::map<std::string, std::function<ViewTask(const Pressed&)>>;

void addPlaying(Keys& keys) {
  keys["space"] = [](const Pressed& p) {
    p.playback.togglePlaying();
    return ViewTask::kRedraw;
  };
  keys["Right"] = keys["period"] = [](const Pressed& p) { return p.step(1); };
  keys["Left"] = keys["comma"] = [](const Pressed& p) { return p.step(-1); };
  keys["Next"] = [](const Pressed& p) { return p.step(10); };
  keys["Prior"] = [](const Pressed& p) { return p.step(-10); };
  keys["Home"] = [](const Pressed& p) { return p.step(-p.playback.index()); };
  keys["End"] = [](const Pressed& p) { return p.step(1 << 30); };
  keys["Up"] = [](const Pressed& p) { return p.speed(2); };
  keys["Down"] = [](const Pressed& p) { return p.speed(0.5); };
  keys["l"] = [](const Pressed& p) { return p.toggle(p.playback.looping); };
}

void addColours(Keys& keys) {
  keys["c"] = [](const Pressed& p) {
    nextColour(p.world, p.state);
    return ViewTask::kRedraw;
  };
  keys["1"] = [](const Pressed& p) { return p.colour(ViewColour::kTexture); };
  keys["2"] = [](const Pressed& p) { return p.colour(ViewColour::kErrors); };
  keys["3"] = [](const Pressed& p) { return p.colour(ViewColour::kWeights); };
  keys["plus"] = keys["equal"] = keys["KP_Add"] = [](const Pressed& p) { return p.dots(1.25); };
  keys["minus"] = keys["KP_Subtract"] = [](const Pressed& p) { return p.dots(0.8); };
}

void addLooks(Keys& keys) {
  keys["v"] = [](const Pressed& p) {
    return p.look(p.state.look == Look::kScope ? Look::kFree : Look::kScope);
  };
  keys["f"] = [](const Pressed& p) { return p.look(Look::kFront); };
  keys["t"] = [](const Pressed& p) { return p.look(Look::kAbove); };
  keys["y"] = [](const Pressed& p) { return p.look(Look::kRight); };
  keys["r"] = [](const Pressed& p) { return p.look(Look::kFree); };
}

void addThings(Keys& keys) {
  keys["n"] = [](const Pressed& p) { return p.toggle(p.state.nodes); };
  keys["a"] = [](const Pressed& p) { return p.toggle(p.state.motion); };
  keys["g"] = [](const Pressed& p) { return p.toggle(p.state.scope); };
  keys["k"] = [](const Pressed& p) { return p.toggle(p.state.ct); };
  keys["m"] = [](const Pressed& p) { return p.toggle(p.state.reference); };
  keys["h"] = keys["question"] = [](const Pressed& p) { return p.toggle(p.state.help); };
  keys["s"] = [](const Pressed&) { return ViewTask::kScreenshot; };
  keys["q"] = keys["Escape"] = [](const Pressed&) { return ViewTask::kQuit; };
}

const Keys& allKeys() {
  static const Keys kKeys = [] {
    Keys keys;
    addPlaying(keys);
    addColours(keys);
    addLooks(keys);
    addThings(keys);
    return keys;
  }();
  return kKeys;
}

}  // namespace

double endSeconds(const ViewSource& source) {
  const int last = source.count() - 1;
  const double stay_s =
      last > 0 ? source.secondsOf(last) - source.secondsOf(last - 1) : kOnlyMoment_s;
  return source.secondsOf(last) + stay_s;
}

void Playback::goTo(int index) {
  index_ = std::clamp(index, 0, source_.count() - 1);
  at_s_ = source_.secondsOf(index_);
}

void Playback::goToTime(double clip_s) {
  goTo(0);
  while (index_ + 1 < source_.count() && source_.secondsOf(index_ + 1) <= clip_s) ++index_;
  at_s_ = clip_s;
}

double Playback::share() const {
  if (index_ + 1 >= source_.count()) return 0;
  const double from_s = source_.secondsOf(index_), to_s = source_.secondsOf(index_ + 1);
  return to_s > from_s ? std::clamp((at_s_ - from_s) / (to_s - from_s), 0.0, 1.0) : 0;
}

void Playback::togglePlaying() {
  playing = !playing;
  if (playing && index_ == source_.count() - 1 && !source_.live()) goTo(0);
}

bool Playback::pass(double seconds) {
  if (!playing) return false;
  const int before = index_, last = source_.count() - 1;
  at_s_ += seconds * speed;
  while (index_ < last && source_.secondsOf(index_ + 1) <= at_s_) ++index_;
  if (at_s_ < endSeconds(source_)) return index_ != before;
  if (looping) {
    goTo(0);
  } else if (source_.live()) {
    at_s_ = source_.secondsOf(last);  // waits for new models
  } else {
    playing = false;
  }
  return true;
}

bool Playback::follow(int count_before) {
  if (playing || source_.count() == count_before || index_ != count_before - 1) return false;
  goTo(source_.count() - 1);
  return true;
}

ViewTask pressKey(const std::string& key, const ViewWorld& world, Playback& playback,
                  ViewState& state) {
  const auto found = allKeys().find(key);
  if (found == allKeys().end()) return ViewTask::kNothing;
  return found->second({world, playback, state});
}

const std::vector<std::pair<std::string, std::string>>& viewKeys() {
  static const std::vector<std::pair<std::string, std::string>> kKeys{
      {"space", "play, pause"},
      {"left right", "one model back, on"},
      {"page up, down", "ten models back, on"},
      {"home end", "first, last model; of a live run: follow it"},
      {"up down", "twice, half as fast"},
      {"l", "loop"},
      {"c, or 1 2 3", "colour: texture, errors, weights"},
      {"+ -", "larger, smaller pieces of surface"},
      {"v", "the scope's own view, and back"},
      {"f t y", "from the front, from above, from the side"},
      {"r", "reset the view"},
      {"n", "nodes of the warp"},
      {"a", "arrows: how the nodes moved, four times as long"},
      {"g", "scope and its path"},
      {"m", "reference mesh"},
      {"k", "slices of the CT"},
      {"s", "screenshot"},
      {"h", "these keys"},
      {"q", "quit"},
      {"mouse", "left: turn; middle, or shift and left: shift; wheel: zoom"}};
  return kKeys;
}

std::vector<ViewColour> coloursOf(const ViewWorld& world) {
  std::vector<ViewColour> colours{ViewColour::kTexture};
  if (world.has_errors) colours.push_back(ViewColour::kErrors);
  if (world.has_weights) colours.push_back(ViewColour::kWeights);
  return colours;
}

}  // namespace softscope
