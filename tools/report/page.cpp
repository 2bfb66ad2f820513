#include "tools/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/report/assets.h"

namespace feedtwin::tools {
namespace {

using Json = nlohmann::json;

constexpr std::size_t longest_list = 64;

std::string shown(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  if (value.is_string()) return escaped(value.get<std::string>());
  if (value.is_null()) return "&ndash;";
  return escaped(value.dump());
}

bool plain(const Json& value) {
  if (!value.is_structured()) return true;
  if (!value.is_array() || value.size() > longest_list) return false;
  for (const auto& element : value) {
    if (element.is_structured()) return false;
  }
  return true;
}

std::string plain_cell(const Json& value) {
  if (!value.is_array()) return shown(value);
  std::string out;
  for (const auto& element : value) out += (out.empty() ? "" : ", ") + shown(element);
  return out;
}

/// Entries that are objects of plain values with mostly the same keys read best as rows of one table.
bool tabular(const Json& value) {
  if (value.size() < 2) return false;
  for (const auto& element : value) {
    if (!element.is_object() || element.empty()) return false;
    for (const auto& cell : element) {
      if (!plain(cell)) return false;
    }
  }
  return true;
}

std::string as_table(const Json& value) {
  std::vector<std::string> columns;
  for (const auto& element : value) {
    for (const auto& [key, cell] : element.items()) {
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) columns.push_back(key);
    }
  }
  std::string out = "<div class=scroll><table><thead><tr><th></th>";
  for (const auto& column : columns) out += "<th>" + escaped(column) + "</th>";
  out += "</tr></thead><tbody>";
  for (const auto& [name, element] : value.items()) {
    out += "<tr><th>" + escaped(name) + "</th>";
    for (const auto& column : columns)
      out += "<td>" + (element.contains(column) ? plain_cell(element[column]) : "") + "</td>";
    out += "</tr>";
  }
  return out + "</tbody></table></div>";
}

std::string section(const Json& value, int depth);

std::string listed(const Json& object, int depth) {
  std::string rows, rest;
  for (const auto& [key, value] : object.items()) {
    if (depth == 0 && key == "figures") continue;
    if (plain(value)) {
      rows += "<tr><th>" + escaped(key) + "</th><td>" + plain_cell(value) + "</td></tr>";
    } else {
      rest += fmt::format("<details{}><summary>{}</summary>{}</details>", depth < 1 ? " open" : "", escaped(key),
                          section(value, depth + 1));
    }
  }
  return (rows.empty() ? "" : "<div class=scroll><table><tbody>" + rows + "</tbody></table></div>") + rest;
}

std::string section(const Json& value, int depth) {
  if (value.is_structured() && tabular(value)) return as_table(value);
  if (value.is_object()) return listed(value, depth);
  if (value.is_array() && value.size() > longest_list) return fmt::format("<p>{} values</p>", value.size());
  return listed(value.is_structured() ? value : Json{{"value", value}}, depth);
}

/// JSON inside a script element: nothing in it may end the element.
std::string in_script(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace), out;
  for (const char c : text) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string report_page(const Json& json, const std::string& title) {
  const Json figures =
      json.is_object() && json.contains("figures") && json["figures"].is_array() ? json["figures"] : Json::array();
  return page_with_figures(
      title, "", figures,
      "<section id=\"numbers\">" + section(json.is_object() ? json : Json{{"values", json}}, 0) + "</section>");
}

std::string page_with_figures(const std::string& title, const std::string& above, const Json& figures,
                              const std::string& below) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>";
  page += escaped(title) + "</title><style>" + std::string(report_style) + "</style></head><body><header><h1>" +
          escaped(title) + "</h1><p>Drag to zoom, double-click for everything, click a name to hide it.</p></header>";
  page += "<main>" + above + "<section id=\"figures\"></section>" + below + "</main>";
  page += "<script type=\"application/json\" id=\"data\">" + in_script(figures) + "</script><script>" +
          std::string(report_script) + "</script></body></html>\n";
  return page;
}

}  // namespace feedtwin::tools
