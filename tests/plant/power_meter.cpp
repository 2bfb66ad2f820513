#include "plant/power_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <random>
#include <vector>

namespace feedtwin::plant {
namespace {

TEST(PowerMeter, ShowsTheMeanOfEachWindowFromItsEndOn) {
  PowerMeter meter;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> power(-100.0, 500.0);
  double sum = 0.0, shown = 0.0, energy_J = 0.0, shown_J = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double now = power(random);
    sum += now;
    energy_J += now * 1e-3;
    const double reading = meter.update(now, 1e-3);
    if ((i + 1) % 100 == 0) {
      shown = sum / 100.0;
      sum = 0.0;
      shown_J += shown * 0.1;
    }
    ASSERT_NEAR(reading, shown, 1e-9) << "tick " << i;
    if (i < 99) {
      ASSERT_EQ(reading, 0.0);
    }
  }
  EXPECT_NEAR(shown_J, energy_J, 1e-6) << "windows lose no energy";
}

/// Of random power, every 100 ticks: the mean of so many, or of what has passed by then.
void expect_means_of(std::ptrdiff_t ticks, PowerMeter meter) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> power(-100.0, 500.0);
  std::vector<double> all;
  for (int i = 0; i < 5000; ++i) {
    all.push_back(power(random));
    const double reading = meter.update(all.back(), 1e-3);
    if (all.size() % 100 != 0) continue;
    const auto span = std::min(ticks, std::ssize(all));
    ASSERT_NEAR(reading, std::accumulate(all.end() - span, all.end(), 0.0) / static_cast<double>(span), 1e-9) << i;
  }
}

TEST(PowerMeter, AWindowMaySpanSeveralReadings) {
  expect_means_of(300, PowerMeter(0.3, 3.0));
}

TEST(PowerMeter, AWindowMayBeTheLastPartBeforeAReading) {
  expect_means_of(75, PowerMeter(0.075, 0.75));
}

TEST(PowerMeter, WindowsDoNotDriftWithTicksThatDoNotDivideThem) {
  PowerMeter meter(0.1);
  double last = 0.0;
  int changes = 0;
  for (int i = 0; i < 30000; ++i) {
    const double reading = meter.update(static_cast<double>(i), 0.4e-3);  // 12 s
    changes += reading != last;
    last = reading;
  }
  EXPECT_EQ(changes, 120);
}

}  // namespace
}  // namespace feedtwin::plant
