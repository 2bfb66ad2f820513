#include "tools/report/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "tools/report/figure.h"

namespace feedtwin::tools {
namespace {

TEST(ReportPage, AsksTheNetworkForNothing) {
  const auto page = report_page({{"verb", "compare"}, {"figures", nlohmann::json::array()}}, "a title");
  for (const char* outside : {"http:", "https:", "src=", "@import", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(ReportPage, LetsNoTextOutOfItsPlace) {
  const std::string bad = "</script><script>alert(1)</script>\"&'";
  const nlohmann::json json{{bad, {{bad, bad}, {"n", {{bad, 1.5}}}}},
                            {"figures", {{{"title", bad}, {"series", nlohmann::json::array()}}}}};
  const auto page = report_page(json, bad);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script>"); at != std::string::npos; at = page.find("</script>", at + 1)) ++ends;
  EXPECT_EQ(ends, 2U);
}

TEST(ReportPage, TakesAnyJson) {
  for (const char* text : {"{}", "[]", "3", "null", R"({"a":[[1,2],[3]],"figures":3})", R"({"figures":[1,{"series":2}]})",
                           R"({"a":[{"b":1},{"c":[1,2]}]})"}) {
    EXPECT_NE(report_page(nlohmann::json::parse(text), "t").find("</html>"), std::string::npos) << text;
  }
}

TEST(Figure, ThinningKeepsEveryPeak) {
  std::mt19937 random(51);
  std::normal_distribution<double> unit;
  std::vector<double> x, y;
  for (int i = 0; i < 50000; ++i) {
    x.push_back(i * 1e-3);
    y.push_back(unit(random));
  }
  y[31234] = 50.0;
  y[777] = -60.0;
  const auto thin = thinned("y", x, y, 1000);
  EXPECT_LE(thin.x.size(), 1100U);
  EXPECT_NE(std::ranges::find(thin.y, 50.0), thin.y.end());
  EXPECT_NE(std::ranges::find(thin.y, -60.0), thin.y.end());
  EXPECT_TRUE(std::ranges::is_sorted(thin.x));
  EXPECT_EQ(thin.x.back(), x.back());
}

}  // namespace
}  // namespace feedtwin::tools
