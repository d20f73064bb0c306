#include "app/library/request/sheet_request.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/library/request/value_text.h"
#include "engine/base/length_unit.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

/// A kind's name and how many numbers it takes that have no key.
struct KindRow {
  const char* name;
  SheetKind kind;
  std::size_t numbers;
  const char* expected;
};
constexpr std::array KINDS = {
    KindRow{"plan", SheetKind::plan, 0, "plan with keys alone, such as plan:z=1.2,scale=50"},
    KindRow{"section", SheetKind::section, 4, "section:X0,Y0,X1,Y1, a line of some length in plan"},
    KindRow{"elevation", SheetKind::elevation, 1,
            "elevation:SIDE, one of north, east, south, west or degrees"},
    KindRow{"ortho", SheetKind::ortho, 3, "ortho:DX,DY,DZ, a direction to look in other than 0,0,0"},
    KindRow{"atlas", SheetKind::atlas, 0, "atlas with keys alone, such as atlas:above=1.2,scale=50"},
};

constexpr std::array SIDES = {"north", "east", "south", "west"};

const KindRow& row_of(SheetKind kind) {
  return *std::find_if(KINDS.begin(), KINDS.end(), [kind](const KindRow& row) { return row.kind == kind; });
}

double positive(const std::string& key, const std::string& text, double most) {
  const auto numbers = split_numbers(text, ',', 1);
  if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] <= most))
    throw Expected{"a " + key + " above 0 and at most " + number_text(most)};
  return numbers[0];
}

constexpr double MOST_LENGTH = 1e30;

double any_number(const std::string& key, const std::string& text) {
  const auto numbers = split_numbers(text, ',', 1);
  if (numbers.empty()) throw Expected{"a finite number for " + key};
  return numbers[0];
}

/// What lines on paper measure, 0 for none.
double millimetres(const std::string& key, const std::string& text) {
  constexpr double MOST = 20.0;
  const auto numbers = split_numbers(text, ',', 1);
  if (numbers.empty() || !(numbers[0] >= 0.0 && numbers[0] <= MOST))
    throw Expected{"a " + key + " of 0 to " + number_text(MOST)};
  return numbers[0];
}

/// Keys that each view of a page has for itself.
bool read_view_key(const std::string& key, const std::string& text, SheetRequest& sheet) {
  if (key == "z" && sheet.kind == SheetKind::plan) {
    sheet.height = any_number(key, text);
  } else if (key == "above" && sheet.kind == SheetKind::atlas) {
    sheet.above = positive(key, text, MOST_LENGTH);
  } else if (key == "depth") {
    sheet.depth = positive(key, text, MOST_LENGTH);
  } else if (key == "contours" && sheet.kind == SheetKind::plan) {
    sheet.contours = positive(key, text, MOST_LENGTH);
  } else {
    return false;
  }
  return true;
}

/// Keys that all views of a page share.
void read_page_key(const std::string& key, const std::string& text, SheetRequest& sheet) {
  if (key == "scale") {
    sheet.scale = positive(key, text, MOST_SHEET_SCALE);
  } else if (key == "dpi") {
    sheet.dpi = positive(key, text, MOST_SHEET_DPI);
  } else if (key == "weight") {
    sheet.weight_mm = millimetres(key, text);
  } else if (key == "hatch") {
    sheet.hatch_mm = millimetres(key, text);
  } else if (key == "level") {
    sheet.level = any_number(key, text);
  } else if (key == "unit") {
    sheet.unit_metres = read_unit(text);
  } else if (key == "paper") {
    if (find_paper(text) == nullptr) throw Expected{"a paper of A4, A3, A2, A1 or A0"};
    sheet.paper = text;
  } else {
    throw Expected{
        "keys depth, scale, dpi, weight, hatch, level, unit and paper, of a plan also z and contours, of an "
        "atlas also above, and portrait or landscape"};
  }
}

constexpr const char *PORTRAIT = "portrait", *LANDSCAPE = "landscape";

/// A number without a key; of elevations also the name of a side.
double read_place(const std::string& text, SheetKind kind) {
  if (kind == SheetKind::elevation)
    for (std::size_t i = 0; i < SIDES.size(); ++i)
      if (text == SIDES[i]) return 90.0 * static_cast<double>(i);
  const auto numbers = split_numbers(text, ',', 1);
  if (numbers.empty()) throw Expected{row_of(kind).expected};
  return numbers[0];
}

bool is_point(const SheetRequest& sheet) {
  const std::vector<double>& p = sheet.place;
  if (sheet.kind == SheetKind::section) return std::hypot(p[2] - p[0], p[3] - p[1]) == 0.0;
  return sheet.kind == SheetKind::ortho && std::hypot(p[0], p[1], p[2]) == 0.0;
}

/// A view; one that is not the first has what all share from that.
SheetRequest read_view(const std::string& text, const SheetRequest& first, bool is_first) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto row = std::find_if(KINDS.begin(), KINDS.end(),
                                [&](const KindRow& kind) { return text.substr(0, colon) == kind.name; });
  if (row == KINDS.end() || (!is_first && row->kind == SheetKind::atlas))
    throw Expected{"plan, section, elevation, ortho or, alone, atlas, such as plan:z=1.2,scale=50,dpi=300" +
                   did_you_mean(text.substr(0, colon), {"plan", "section", "elevation", "ortho", "atlas"})};
  SheetRequest sheet = first;
  sheet.kind = row->kind;
  sheet.place.clear();
  sheet.height.reset();
  sheet.depth.reset();
  sheet.contours.reset();
  if (colon < text.size())
    for (const std::string& part : split_names(text.substr(colon + 1))) {
      const std::size_t equals = part.find('=');
      const bool is_turn = part == PORTRAIT || part == LANDSCAPE;
      if (!is_turn && equals == std::string::npos)
        sheet.place.push_back(read_place(part, sheet.kind));
      else if (!is_turn && read_view_key(part.substr(0, equals), part.substr(equals + 1), sheet))
        continue;
      else if (!is_first)
        throw Expected{"of views behind the first the keys depth, z and contours, as they have its scale"};
      else if (is_turn)
        sheet.turn = part == PORTRAIT ? PaperTurn::portrait : PaperTurn::landscape;
      else
        read_page_key(part.substr(0, equals), part.substr(equals + 1), sheet);
    }
  if (sheet.place.size() != row->numbers || is_point(sheet)) throw Expected{row->expected};
  return sheet;
}

/// Writes a list of parts behind a kind's name.
class ViewText {
 public:
  explicit ViewText(const SheetRequest& sheet) : text_(row_of(sheet.kind).name) {
    for (const double number : sheet.place) add(number_text(number));
    if (sheet.height) add("z=" + number_text(*sheet.height));
    if (sheet.above) add("above=" + number_text(*sheet.above));
    if (sheet.depth) add("depth=" + number_text(*sheet.depth));
    if (sheet.contours) add("contours=" + number_text(*sheet.contours));
  }
  void add(const std::string& part) {
    text_ += before_ + part;
    before_ = ',';
  }
  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  std::string text_;
  char before_ = ':';
};

}  // namespace

double read_unit(const std::string& text) {
  for (const LengthUnit& unit : LENGTH_UNITS)
    if (text == unit.symbol) return unit.metres;
  const auto numbers = split_numbers(text, ',', 1);
  if (numbers.empty() || !(numbers[0] > 0.0))
    throw Expected{"a unit of m, cm, mm, ft, us-ft or a number of metres"};
  return numbers[0];
}

SheetRequest read_sheet(const std::string& text) {
  const std::size_t semicolon = std::min(text.find(';'), text.size());
  SheetRequest sheet = read_view(text.substr(0, semicolon), {}, /*is_first=*/true);
  const SheetRequest first = sheet;
  for (std::size_t begin = semicolon; begin < text.size();) {
    const std::size_t end = std::min(text.find(';', begin + 1), text.size());
    sheet.others.push_back(read_view(text.substr(begin + 1, end - begin - 1), first, /*is_first=*/false));
    begin = end;
  }
  if (!sheet.others.empty() && first.kind == SheetKind::atlas)
    throw Expected{"an atlas alone, as it has a page for each floor"};
  return sheet;
}

std::string sheet_text(const SheetRequest& sheet) {
  const SheetRequest plain;
  ViewText first(sheet);
  const auto add_number = [&first](const char* key, double value, double usual) {
    if (value != usual) first.add(key + number_text(value));
  };
  add_number("scale=", sheet.scale, plain.scale);
  add_number("dpi=", sheet.dpi, plain.dpi);
  add_number("weight=", sheet.weight_mm, plain.weight_mm);
  add_number("hatch=", sheet.hatch_mm, plain.hatch_mm);
  if (sheet.level) first.add("level=" + number_text(*sheet.level));
  if (sheet.unit_metres) first.add("unit=" + number_text(*sheet.unit_metres));
  if (!sheet.paper.empty()) first.add("paper=" + sheet.paper);
  if (sheet.turn != PaperTurn::chosen) first.add(sheet.turn == PaperTurn::portrait ? PORTRAIT : LANDSCAPE);
  std::string text = first.str();
  for (const SheetRequest& other : sheet.others) text += ";" + ViewText(other).str();
  return text;
}

}  // namespace splatray
