// vtk_views/viewer/view_window.cpp: VTK window and mouse with own keys, clock and foot.
#include "vtk_views/viewer/view_window.h"

#include <vtkActor2D.h>
#include <vtkCallbackCommand.h>
#include <vtkImageMapper.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>

#include <chrono>
#include <exception>

#include "vtk_views/scenes/view_camera.h"
#include "vtk_views/scenes/window_pixels.h"
#include "vtk_views/viewer/moment_between.h"
#include "vtk_views/viewer/view_picture.h"
#include "vtk_views/viewer/view_scene.h"
#include "vtk_views/viewer/view_sheet.h"
#include "vtk_views/viewer/x_display.h"

namespace softscope {
namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned long kTick_ms = 20;
constexpr double kLookEvery_s = 0.5;  // polling interval of a live run

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Unscaled image in the window.
class PictureActor {
 public:
  PictureActor() {
    mapper_->SetColorWindow(255);
    mapper_->SetColorLevel(127.5);
    actor_->SetMapper(mapper_);
  }
  vtkActor2D* actor() { return actor_; }
  void show(const ColourImage& picture) { mapper_->SetInputData(vtkImageOf(picture)); }

 private:
  vtkNew<vtkImageMapper> mapper_;
  vtkNew<vtkActor2D> actor_;
};

/// Actions of mouse and keys, called by the interactor style.
class ViewHandler {
 public:
  virtual ~ViewHandler() = default;
  virtual void press(const std::string& key) = 0;
  virtual bool onSlider(int y_px) const = 0;
  virtual void seek(int x_px) = 0;
  virtual void cameraMoves() = 0;
  virtual void tick() = 0;
};

/// VTK's trackball style without its keys.
class ViewStyle : public vtkInteractorStyleTrackballCamera {
 public:
  static ViewStyle* New();
  vtkTypeMacro(ViewStyle, vtkInteractorStyleTrackballCamera)

  ViewHandler* handler = nullptr;

  void OnKeyPress() override { handler->press(Interactor->GetKeySym()); }
  void OnChar() override {}
  void OnTimer() override { handler->tick(); }
  void OnLeftButtonDown() override {
    const int* at = Interactor->GetEventPosition();
    seeking_ = handler->onSlider(at[1]);
    if (seeking_)
      handler->seek(at[0]);
    else
      Superclass::OnLeftButtonDown();
  }
  void OnMouseMove() override {
    if (seeking_)
      handler->seek(Interactor->GetEventPosition()[0]);
    else
      Superclass::OnMouseMove();
  }
  void OnLeftButtonUp() override {
    if (!seeking_) Superclass::OnLeftButtonUp();
    seeking_ = false;
  }
  void Rotate() override {
    handler->cameraMoves();
    Superclass::Rotate();
  }
  void Spin() override {
    handler->cameraMoves();
    Superclass::Spin();
  }
  void Pan() override {
    handler->cameraMoves();
    Superclass::Pan();
  }

 protected:
  void Dolly(double factor) override {
    handler->cameraMoves();
    Superclass::Dolly(factor);
  }

 private:
  bool seeking_ = false;
};
vtkStandardNewMacro(ViewStyle);

}  // namespace

class ViewWindow::Parts : public ViewHandler {
 public:
  Parts(ViewSource& source, ViewWindowOptions options);
  ~Parts() override;
  void run();

  void press(const std::string& key) override;
  bool onSlider(int y_px) const override {
    return y_px < kViewFootPx && y_px >= kViewFootPx - kSliderPx;
  }
  void seek(int x_px) override;
  void cameraMoves() override;
  void tick() override;

  ViewSource& source;
  ViewWindowOptions options;
  Playback playback;
  ViewState state;
  ViewPace pace;
  std::shared_ptr<void> display_;  // must outlive the window
  vtkSmartPointer<vtkRenderWindow> window_;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor_;

 private:
  void open();
  void loop();
  void doTask(ViewTask task);
  void showMoment();
  void render();
  void beforeRender();
  void layOut();
  void pollSource();
  double aspect() const;
  int width() const { return window_->GetSize()[0]; }
  int height() const { return window_->GetSize()[1]; }
  /// VTK's event loop does not pass exceptions: they stop it, and run() rethrows them.
  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (...) {
      failure_ = std::current_exception();
      interactor_->TerminateApp();
    }
  }

  ViewScene scene_;
  ColourImage card_ = drawViewHelp();
  PictureActor foot_, help_;
  vtkNew<vtkRenderer> foot_renderer_;
  vtkNew<ViewStyle> style_;
  std::shared_ptr<const ViewMoment> moment_;
  Clock::time_point last_tick_ = Clock::now(), last_look_ = Clock::now();
  std::exception_ptr failure_;
  bool looped_ = false;
};

ViewWindow::Parts::Parts(ViewSource& the_source, ViewWindowOptions the_options)
    : source(the_source),
      options(std::move(the_options)),
      playback(source),
      state(options.state),
      scene_(source.world()) {
  requireViewSize(options.width_px, options.height_px);
  display_ = connectToDisplay();
  playback.goTo(options.first);
  playback.playing = options.playing;
  playback.speed = options.speed;
  moment_ = source.moment(playback.index(), state.colour == ViewColour::kErrors);
  help_.show(card_);
  open();
  showMoment();
  scene_.look(*moment_, state, aspect());
  render();
}

/// VTK polls every window ever opened until its event loop ends.
ViewWindow::Parts::~Parts() {
  if (!looped_) {
    options.closes = [] { return true; };
    loop();
  }
  window_->RemoveAllObservers();
}

void ViewWindow::Parts::open() {
  window_ = newWindowOnDisplay();
  window_->SetSize(options.width_px, options.height_px);
  window_->SetWindowName("softscope view");
  window_->SetMultiSamples(0);  // 4 samples need 3 to 4 times the frame time on Mesa
  foot_renderer_->SetBackground(1, 1, 1);
  foot_renderer_->InteractiveOff();
  foot_renderer_->AddActor(foot_.actor());
  scene_.renderer()->AddActor(help_.actor());
  window_->AddRenderer(scene_.renderer());
  window_->AddRenderer(foot_renderer_);
  vtkNew<vtkCallbackCommand> before;
  before->SetClientData(this);
  before->SetCallback([](vtkObject*, unsigned long, void* parts, void*) {
    static_cast<Parts*>(parts)->beforeRender();
  });
  window_->AddObserver(vtkCommand::StartEvent, before);
  interactor_ = vtkSmartPointer<vtkRenderWindowInteractor>::New();
  interactor_->SetRenderWindow(window_);
  style_->handler = this;
  interactor_->SetInteractorStyle(style_);
  interactor_->Initialize();
}

double ViewWindow::Parts::aspect() const {
  return double(width()) / std::max(height() - kViewFootPx, 1);
}

void ViewWindow::Parts::layOut() {
  const double share = std::min(0.9, double(kViewFootPx) / std::max(height(), 1));
  scene_.renderer()->SetViewport(0, share, 1, 1);
  foot_renderer_->SetViewport(0, 0, 1, share);
  help_.actor()->SetPosition((width() - card_.width_px) / 2,
                             (height() - kViewFootPx - card_.height_px) / 2);
  help_.actor()->SetVisibility(state.help);
}

void ViewWindow::Parts::beforeRender() {
  if (!moment_) return;
  layOut();
  scene_.sizeFor(1);
  const ViewFoot foot =
      footOf(source, *moment_, playback, state, scene_.widthShownMm(aspect()), /*of_window=*/true);
  foot_.show(drawViewFoot(foot, width()));
}

void ViewWindow::Parts::render() { interactor_->Render(); }

void ViewWindow::Parts::showMoment() {
  const auto start = Clock::now();
  moment_ = shownMoment(source, playback, state.colour == ViewColour::kErrors);
  scene_.show(*moment_, state);
  render();
  ++pace.pictures;
  pace.seconds += secondsSince(start);
}

void ViewWindow::Parts::doTask(ViewTask task) {
  if (task == ViewTask::kNothing) return;
  if (task == ViewTask::kQuit) return interactor_->TerminateApp();
  if (task == ViewTask::kScreenshot) {
    if (options.save) options.save(readPixels(window_, width(), height(), 1), moment_->frame);
    return;
  }
  if (task == ViewTask::kLook) scene_.look(*moment_, state, aspect());
  showMoment();
}

void ViewWindow::Parts::press(const std::string& key) {
  guarded([&] { doTask(pressKey(key, source.world(), playback, state)); });
}

void ViewWindow::Parts::seek(int x_px) {
  guarded([&] {
    const ViewFoot foot =
        footOf(source, *moment_, playback, state, std::nan(""), /*of_window=*/true);
    const int index = nearestMoment(foot.places, sliderPlace(x_px, width()));
    if (index == playback.index()) return;
    playback.goTo(index);
    showMoment();
  });
}

/// A rotation by the user leaves the scope view.
void ViewWindow::Parts::cameraMoves() {
  if (state.look == Look::kScope) makeParallel(scene_.renderer());
  if (state.look == Look::kFree) return;
  state.look = Look::kFree;
  guarded([&] { scene_.show(*moment_, state); });
}

void ViewWindow::Parts::pollSource() {
  if (!source.live() || secondsSince(last_look_) < kLookEvery_s) return;
  last_look_ = Clock::now();
  const int before = source.count();
  const bool stopped_before = source.stopped();
  source.look();
  if (playback.follow(before))
    showMoment();
  else if (source.count() != before || !source.live() || source.stopped() != stopped_before)
    render();
}

void ViewWindow::Parts::tick() {
  guarded([&] {
    const double passed_s = secondsSince(last_tick_);
    last_tick_ = Clock::now();
    if (options.closes()) return interactor_->TerminateApp();
    pollSource();
    const double before = playback.share();
    if (playback.pass(passed_s) || (playback.playing && playback.share() != before)) showMoment();
  });
}

void ViewWindow::Parts::loop() {
  last_tick_ = Clock::now();
  looped_ = true;
  interactor_->CreateRepeatingTimer(kTick_ms);
  interactor_->Start();
}

void ViewWindow::Parts::run() {
  loop();
  if (failure_) std::rethrow_exception(failure_);
}

ViewWindow::ViewWindow(ViewSource& source, ViewWindowOptions options)
    : parts_(std::make_unique<Parts>(source, std::move(options))) {}
ViewWindow::~ViewWindow() = default;

void ViewWindow::run() { parts_->run(); }
ColourImage ViewWindow::pixels() const {
  const int* size = parts_->window_->GetSize();
  return readPixels(parts_->window_, size[0], size[1], 1);
}
ViewPace ViewWindow::pace() const { return parts_->pace; }
vtkRenderWindowInteractor* ViewWindow::interactor() { return parts_->interactor_; }
const Playback& ViewWindow::playback() const { return parts_->playback; }
const ViewState& ViewWindow::state() const { return parts_->state; }

}  // namespace softscope
