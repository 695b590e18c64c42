// tests/toolkit/stereo_sync_test.cpp: warnings of views that do not fit the calibration.
#include "toolkit/run/stereo_sync.h"

#include <gmock/gmock.h>

#include "support/in_folder.h"
#include "tests/toolkit/made_sequences.h"
#include "tests/toolkit/records.h"

namespace softscope::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class RelatedViews : public InFolder {
 protected:
  ReconstructOptions clipWith(const std::vector<std::string>& errors) const {
    simulateClip(at("clip"), 5, errors);
    return reconstruction(at("clip"), at("run"));
  }
};

TEST_F(RelatedViews, OfACalibratedClipHaveNoWarning) {
  ReconstructOptions options = clipWith({});
  const ViewRelation views =
      relateViews(options.sequence, options.settings.method.depth, options.settings.sequence);
  EXPECT_THAT(views.warnings, IsEmpty());
}

TEST_F(RelatedViews, OfARolledCameraAreToldAndRecorded) {
  const ReconstructOptions options = clipWith({"scope.roll_error_deg=5"});
  Told told;
  const Json done = written(reconstructSequence(options, told.listener()).record);
  const auto ofRoll = HasSubstr("the right view is rolled by ");
  EXPECT_THAT(told.warnings, Contains(ofRoll));
  EXPECT_THAT(done["warnings"].get<std::vector<std::string>>(), Contains(ofRoll));
}

}  // namespace
}  // namespace softscope::test
