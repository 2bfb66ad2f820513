#include "controllers/gcode/expression.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

namespace feedtwin::controllers::gcode {
namespace {

constexpr int deepest_nesting = 50;
constexpr double degree_rad = std::numbers::pi / 180.0;
constexpr double equal_within = 1e-4;  // EQ and NE of the language compare with this tolerance

using Function = double (*)(double);
struct NamedFunction {
  std::string_view name;
  Function apply;
};
constexpr std::array functions{
    NamedFunction{"abs", [](double v) { return std::abs(v); }},
    NamedFunction{"acos", [](double v) { return std::acos(v) / degree_rad; }},
    NamedFunction{"asin", [](double v) { return std::asin(v) / degree_rad; }},
    NamedFunction{"cos", [](double v) { return std::cos(v * degree_rad); }},
    NamedFunction{"exp", [](double v) { return std::exp(v); }},
    NamedFunction{"fix", [](double v) { return std::floor(v); }},
    NamedFunction{"fup", [](double v) { return std::ceil(v); }},
    NamedFunction{"ln", [](double v) { return std::log(v); }},
    NamedFunction{"round", [](double v) { return std::round(v); }},
    NamedFunction{"sin", [](double v) { return std::sin(v * degree_rad); }},
    NamedFunction{"sqrt", [](double v) { return std::sqrt(v); }},
    NamedFunction{"tan", [](double v) { return std::tan(v * degree_rad); }},
};

using Operation = double (*)(double, double);
struct Operator {
  std::string_view name;
  int precedence;
  Operation apply;
};
constexpr std::array operators{
    Operator{"**", 6, [](double a, double b) { return std::pow(a, b); }},
    Operator{"*", 5, [](double a, double b) { return a * b; }},
    Operator{"/", 5, [](double a, double b) { return a / b; }},
    Operator{"mod", 5,
             [](double a, double b) {
               const double rest = std::fmod(a, b);
               return rest < 0.0 ? rest + std::abs(b) : rest;
             }},
    Operator{"+", 4, [](double a, double b) { return a + b; }},
    Operator{"-", 4, [](double a, double b) { return a - b; }},
    Operator{"eq", 3, [](double a, double b) { return std::abs(a - b) < equal_within ? 1.0 : 0.0; }},
    Operator{"ne", 3, [](double a, double b) { return std::abs(a - b) < equal_within ? 0.0 : 1.0; }},
    Operator{"gt", 3, [](double a, double b) { return a > b ? 1.0 : 0.0; }},
    Operator{"ge", 3, [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
    Operator{"lt", 3, [](double a, double b) { return a < b ? 1.0 : 0.0; }},
    Operator{"le", 3, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
    Operator{"and", 2, [](double a, double b) { return a != 0.0 && b != 0.0 ? 1.0 : 0.0; }},
    Operator{"or", 2, [](double a, double b) { return a != 0.0 || b != 0.0 ? 1.0 : 0.0; }},
    Operator{"xor", 2, [](double a, double b) { return (a != 0.0) != (b != 0.0) ? 1.0 : 0.0; }},
};
constexpr int lowest_precedence = 2;

class Reader {
 public:
  Reader(Scanner& scanner, const Parameters& parameters) : in_(scanner), parameters_(parameters) {}

  double value() {
    const std::size_t from = in_.at();
    const Nesting deeper(*this);
    double result = 0.0;
    const char c = in_.peek();
    if (c == '[') {
      result = bracketed();
    } else if (c == '#') {
      in_.take();
      result = parameter(from);
    } else if (c == '+' || c == '-') {
      in_.take();
      const char next = in_.peek();
      if (next == '+' || next == '-') in_.fail("two signs in a row");
      result = c == '-' ? -value() : value();
    } else if (c == '.' || is_digit(c)) {
      result = number();
    } else if (is_letter(c)) {
      result = function();
    } else {
      in_.fail(c == '\0' ? std::string("expected a value, found the end of the line")
                         : std::string("expected a value, found '") + c + "'");
    }
    if (!std::isfinite(result)) in_.fail(from, "the value is not a finite number");
    return result;
  }

  ParameterName parameter_name() {
    if (in_.take_if('<')) {
      std::string name;
      for (const char c : in_.take_until('>', "the parameter's name")) {
        if (c != ' ' && c != '\t') name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
      if (name.empty()) in_.fail("the parameter has no name");
      return {0, name};
    }
    const std::size_t from = in_.at();
    const double index = value();
    const double whole = std::round(index);
    if (std::abs(index - whole) > equal_within || whole < 1.0 || whole >= parameter_count) {
      in_.fail(from, "expected a parameter number from 1 to 5601");
    }
    return {static_cast<int>(whole), {}};
  }

 private:
  struct Nesting {
    explicit Nesting(Reader& reader) : reader_(reader) {
      if (++reader_.depth_ > deepest_nesting) reader_.in_.fail("the expression is nested too deeply");
    }
    ~Nesting() { --reader_.depth_; }
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;
    Reader& reader_;
  };

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

  double number() {
    const std::size_t from = in_.at();
    std::string digits;
    bool point = false;
    for (char c = in_.peek(); is_digit(c) || (c == '.' && !point); c = in_.peek()) {
      point = point || c == '.';
      digits += in_.take();
    }
    double result = 0.0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), result, std::chars_format::fixed);
    if (error != std::errc{} || end != digits.data() + digits.size()) in_.fail(from, "expected a number");
    return result;
  }

  double parameter(std::size_t from) {
    const ParameterName name = parameter_name();
    if (name.number > 0) return parameters_.numbered[static_cast<std::size_t>(name.number)];
    const auto found = parameters_.named.find(name.name);
    if (found == parameters_.named.end()) in_.fail(from, "the parameter #<" + name.name + "> was never set");
    return found->second;
  }

  std::string word() {
    std::string letters;
    while (is_letter(in_.peek())) letters += in_.take();
    return letters;
  }

  double function() {
    const std::size_t from = in_.at();
    const std::string name = word();
    if (name == "atan") {
      const double y = bracketed();
      if (!in_.take_if('/')) in_.fail("expected /[...] after ATAN[...]");
      return std::atan2(y, bracketed()) / degree_rad;
    }
    if (name == "exists") return exists();
    for (const auto& known : functions) {
      if (known.name == name) return known.apply(bracketed());
    }
    in_.fail(from, "expected a value, found '" + name + "'");
  }

  double exists() {
    if (!in_.take_if('[') || !in_.take_if('#')) in_.fail("expected [#<name>] after EXISTS");
    const ParameterName name = parameter_name();
    if (!in_.take_if(']')) in_.fail("expected ']'");
    return name.number > 0 || parameters_.named.contains(name.name) ? 1.0 : 0.0;
  }

  double bracketed() {
    if (!in_.take_if('[')) in_.fail("expected '['");
    const Nesting deeper(*this);
    const double result = operation(lowest_precedence, value());
    in_.take();  // the ']' that ended the operation
    return result;
  }

  /// Operators of at least this precedence, left to right, up to the closing bracket.
  double operation(int lowest, double left) {
    for (;;) {
      const Operator* next = peek_operator();
      if (next == nullptr || next->precedence < lowest) return left;
      pending_ = nullptr;
      double right = value();
      for (const Operator* tighter = peek_operator(); tighter != nullptr && tighter->precedence > next->precedence;
           tighter = peek_operator()) {
        right = operation(tighter->precedence, right);
      }
      left = next->apply(left, right);
    }
  }

  /// The operator that stands here, read once; nullptr before the closing bracket.
  const Operator* peek_operator() {
    if (pending_ != nullptr) return pending_;
    const char c = in_.peek();
    if (c == ']') return nullptr;
    const std::size_t from = in_.at();
    std::string name;
    if (is_letter(c)) {
      // values can't start with an operator's letters, so taking letters one by one finds it
      while (is_letter(in_.peek()) && find_operator(name) == nullptr) name += in_.take();
    } else if (c != '\0') {
      name += in_.take();
      if (c == '*' && in_.take_if('*')) name += '*';
    }
    pending_ = find_operator(name);
    if (pending_ == nullptr) {
      in_.fail(from, name.empty() ? "expected ']', found the end of the line" : "unknown operator '" + name + "'");
    }
    return pending_;
  }

  static const Operator* find_operator(std::string_view name) {
    for (const auto& known : operators) {
      if (known.name == name) return &known;
    }
    return nullptr;
  }

  Scanner& in_;
  const Parameters& parameters_;
  const Operator* pending_ = nullptr;
  int depth_ = 0;
};

}  // namespace

double read_value(Scanner& scanner, const Parameters& parameters) {
  return Reader(scanner, parameters).value();
}

ParameterName read_parameter_name(Scanner& scanner, const Parameters& parameters) {
  return Reader(scanner, parameters).parameter_name();
}

}  // namespace feedtwin::controllers::gcode
