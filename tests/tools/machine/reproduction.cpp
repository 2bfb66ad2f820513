#include "tools/machine/reproduction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/machine/reciprocation.h"
#include "tools/machine/reproduction_page.h"

namespace feedtwin::tools {
namespace {

TEST(Reproduction, MeetsEveryTargetAndExplainsWhatDiffers) {
  const Reproduction r = make_reproduction(2);
  EXPECT_TRUE(r.targets_met());
  int targets = 0;
  for (const auto& n : r.numbers) {
    targets += n.target ? 1 : 0;
    if (std::abs(n.deviation()) > 0.05) {
      EXPECT_FALSE(n.reason.empty()) << n.where << " " << n.quantity;
    }
  }
  EXPECT_EQ(targets, 12);
  const std::string page = reproduction_page(r);
  for (const char* part : {"Table 3", "Table 4", "Table 5", "Fig. 7", "Fig. 8", "Fig. 9", "Fig. 10", "Fig. 11", "Eq. 15"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page stands on its own";
  for (const auto& choice : free_choices()) EXPECT_NE(page.find(choice.substr(0, 20)), std::string::npos) << choice;
}

TEST(Reproduction, AMissedTargetIsNoticed) {
  Reproduction r;
  r.numbers = {{"", "", "", 1.0, 1.04, "", true}};
  EXPECT_TRUE(r.targets_met());
  r.numbers.push_back({"", "", "", 1.0, 0.94, "", true});
  EXPECT_FALSE(r.targets_met());
}

TEST(Reproduction, ReciprocationFindsWhatItMade) {
  const auto first = closest_reciprocation("triangle", {16.80, 9.19, 32.25, 1.94});
  const auto again = closest_reciprocation("triangle", first.energy_J);
  EXPECT_NEAR(again.speed_m_per_s, first.speed_m_per_s, 1e-9);
  EXPECT_NEAR(again.duration_s / first.duration_s, 1.0, 1e-9);
}

}  // namespace
}  // namespace feedtwin::tools
