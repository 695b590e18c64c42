// tests/calibrate/view_choice_test.cpp: blurred and doubled views are left out and named.
#include "calibrate/view_choice.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace softscope {
namespace {

BoardSighting sighting(int frame, double shift_px, double edge_width_px) {
  BoardSighting one;
  one.frame = frame;
  one.edge_width_px = edge_width_px;
  for (int id = 0; id < 20; ++id)
    one.left.push_back({id, {20.0 * (id % 5) + shift_px, 20.0 * (id / 5)}});
  one.right = one.left;
  return one;
}

TEST(ViewChoice, BlurredAndDoubledViewsAreNamed) {
  const ViewChoice choice = chooseViews(
      {sighting(0, 0, 2.2), sighting(1, 3, 2.0), sighting(2, 50, 5.0), sighting(3, 100, 2.1)});
  EXPECT_EQ(choice.used, (std::vector<std::size_t>{1, 3}));
  ASSERT_EQ(choice.left_out.size(), 2u);
  EXPECT_EQ(choice.left_out[0].frame, 0);
  EXPECT_NE(choice.left_out[0].why.find("frame 1"), std::string::npos) << choice.left_out[0].why;
  EXPECT_EQ(choice.left_out[1].frame, 2);
  EXPECT_NE(choice.left_out[1].why.find("blurred"), std::string::npos) << choice.left_out[1].why;
}

TEST(ViewChoice, OfManyTheMostUnlikeOnesAreKept) {
  std::vector<BoardSighting> many;
  for (int i = 0; i < 50; ++i) many.push_back(sighting(i, 11.0 * i, 2));
  ViewChoiceOptions options;
  options.most_views = 3;
  const ViewChoice choice = chooseViews(many, options);
  EXPECT_EQ(choice.used, (std::vector<std::size_t>{0, 24, 49}));
  EXPECT_EQ(choice.left_out.size(), 47u);
}

TEST(ViewChoice, WithoutSightingsThereIsNoChoice) {
  EXPECT_TRUE(chooseViews({}).used.empty());
  ViewChoiceOptions options;
  options.most_views = 2;
  EXPECT_THROW(options.validate(), OptionError);
}

}  // namespace
}  // namespace softscope
