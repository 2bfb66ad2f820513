#include "io/gpio/libgpiod_lines.h"

#include <gpiod.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "io/port.h"

namespace feedtwin::io::gpio {
namespace {

constexpr const char* consumer = "feedtwin";

PortError failed(const ChipSettings& settings, const std::string& what) {
  return PortError(settings.chip + ": " + what + ": " + std::strerror(errno));
}

#if FEEDTWIN_GPIOD_MAJOR >= 2

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* pointer) const noexcept {
    Free(pointer);
  }
};

class ChipLines final : public Lines {
 public:
  explicit ChipLines(ChipSettings settings) : settings_(std::move(settings)) {}

  void open(std::uint64_t levels) override {
    chip_.reset(gpiod_chip_open(settings_.chip.c_str()));
    if (!chip_) throw failed(settings_, "can't open the chip");
    const std::unique_ptr<gpiod_line_settings, Freed<gpiod_line_settings_free>> low(gpiod_line_settings_new());
    const std::unique_ptr<gpiod_line_settings, Freed<gpiod_line_settings_free>> high(gpiod_line_settings_new());
    const std::unique_ptr<gpiod_line_config, Freed<gpiod_line_config_free>> lines(gpiod_line_config_new());
    const std::unique_ptr<gpiod_request_config, Freed<gpiod_request_config_free>> request(gpiod_request_config_new());
    if (!low || !high || !lines || !request) throw failed(settings_, "no memory");
    gpiod_line_settings_set_direction(low.get(), GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_direction(high.get(), GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_output_value(high.get(), GPIOD_LINE_VALUE_ACTIVE);
    for (std::size_t i = 0; i < settings_.offsets.size(); ++i) {
      auto* setting = (levels >> i & 1U) != 0 ? high.get() : low.get();
      if (gpiod_line_config_add_line_settings(lines.get(), &settings_.offsets[i], 1, setting) != 0) {
        throw failed(settings_, "can't set up its lines");
      }
    }
    gpiod_request_config_set_consumer(request.get(), consumer);
    request_.reset(gpiod_chip_request_lines(chip_.get(), request.get(), lines.get()));
    if (!request_) throw failed(settings_, "can't have its lines as outputs");
  }
  void close() noexcept override {
    request_.reset();
    chip_.reset();
  }
  bool set(std::uint64_t levels) noexcept override {
    std::array<gpiod_line_value, most_lines> values{};
    for (std::size_t i = 0; i < settings_.offsets.size(); ++i) {
      values[i] = (levels >> i & 1U) != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    }
    return gpiod_line_request_set_values(request_.get(), values.data()) == 0;
  }

 private:
  ChipSettings settings_;
  std::unique_ptr<gpiod_chip, Freed<gpiod_chip_close>> chip_;
  std::unique_ptr<gpiod_line_request, Freed<gpiod_line_request_release>> request_;
};

#else

class ChipLines final : public Lines {
 public:
  explicit ChipLines(ChipSettings settings) : settings_(std::move(settings)) {}
  ~ChipLines() override { ChipLines::close(); }

  void open(std::uint64_t levels) override {
    chip_ = gpiod_chip_open(settings_.chip.c_str());
    if (chip_ == nullptr) throw failed(settings_, "can't open the chip");
    auto offsets = settings_.offsets;
    const auto values = to_values(levels);
    if (gpiod_chip_get_lines(chip_, offsets.data(), static_cast<unsigned>(offsets.size()), &bulk_) != 0) {
      throw failed(settings_, "has no such lines");
    }
    if (gpiod_line_request_bulk_output(&bulk_, consumer, values.data()) != 0) {
      throw failed(settings_, "can't have its lines as outputs");
    }
  }
  void close() noexcept override {
    if (chip_ == nullptr) return;
    gpiod_chip_close(chip_);  // releases its lines
    chip_ = nullptr;
  }
  bool set(std::uint64_t levels) noexcept override {
    const auto values = to_values(levels);
    return gpiod_line_set_value_bulk(&bulk_, values.data()) == 0;
  }

 private:
  static std::array<int, most_lines> to_values(std::uint64_t levels) noexcept {
    std::array<int, most_lines> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(levels >> i & 1U);
    return values;
  }

  ChipSettings settings_;
  gpiod_chip* chip_ = nullptr;
  gpiod_line_bulk bulk_{};
};

#endif

}  // namespace

std::unique_ptr<Lines> open_chip(ChipSettings settings) {
  return std::make_unique<ChipLines>(std::move(settings));
}

}  // namespace feedtwin::io::gpio
