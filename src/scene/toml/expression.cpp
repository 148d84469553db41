#include "src/scene/toml/expression.hpp"

#include <muParser.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "cellgrid/parallel/types.hpp"

namespace freshet::input {
namespace {

struct Expression {
  mu::Parser parser;
  double x = 0, y = 0;
};

// muparser would take `x = 3` as an assignment to x.
int position_of_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool after = i + 1 < text.size() && text[i + 1] == '=';
    const bool before = i > 0 && std::string("<>!=").find(text[i - 1]) != std::string::npos;
    if (!after && !before) return static_cast<int>(i);
  }
  return -1;
}

std::vector<std::string> known_names(const mu::Parser& parser) {
  std::vector<std::string> names = {"x", "y", "pi", "g"};
  for (const auto& function : parser.GetFunDef()) names.push_back(function.first);
  return names;
}

ExpressionError explained(const mu::Parser& parser, const mu::Parser::exception_type& error, int length) {
  std::string message, help;
  const std::string token = error.GetToken();
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      message = "unknown name '" + token + "'";
      help = token == "t" ? "beds and initial states do not depend on time"
                          : did_you_mean(token, known_names(parser));
      if (help.empty()) help = "variables are x and y [m], constants pi and g";
      break;
    case mu::ecUNEXPECTED_EOF: message = "the expression ends too early"; break;
    case mu::ecEMPTY_EXPRESSION: message = "the expression is empty"; break;
    case mu::ecMISSING_PARENS: message = "a parenthesis is not closed"; break;
    case mu::ecUNEXPECTED_PARENS: message = "unexpected parenthesis"; break;
    case mu::ecUNEXPECTED_OPERATOR: message = "unexpected operator '" + token + "'"; break;
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR: message = "an operator is missing before '" + token + "'"; break;
    default: message = error.GetMsg();
  }
  const bool at_end = error.GetCode() == mu::ecUNEXPECTED_EOF || error.GetCode() == mu::ecMISSING_PARENS;
  return {at_end ? length : std::clamp(error.GetPos(), 0, length), message, help};
}

}  // namespace

Function compile_expression(const std::string& text, double gravity) {
  const int assignment = position_of_assignment(text);
  if (assignment >= 0)
    throw ExpressionError{assignment, "'=' assigns; it cannot stand here", "compare with '=='"};
  const auto expression = std::make_shared<Expression>();
  mu::Parser& parser = expression->parser;
  parser.ClearConst();
  parser.DefineConst("pi", pi);
  parser.DefineConst("g", gravity);
  parser.DefineVar("x", &expression->x);
  parser.DefineVar("y", &expression->y);
  try {
    parser.SetExpr(text);
    parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw explained(parser, error, static_cast<int>(text.size()));
  }
  if (parser.GetNumResults() != 1) {
    throw ExpressionError{static_cast<int>(text.find(',')), "one value is wanted, not several",
                          "numbers have a decimal point, not a comma"};
  }
  return [expression](double x, double y) {
    expression->x = x;
    expression->y = y;
    return expression->parser.Eval();
  };
}

Place place_in_string(const std::string& source, const Place& string, int position) {
  Place place = string;
  std::size_t at = 0;
  for (int line = 1; line < string.line; ++line) at = source.find('\n', at) + 1;
  for (int column = 1; column < string.column && at < source.size(); ++column) {
    ++at;
    while (at < source.size() && (static_cast<unsigned char>(source[at]) & 0xC0) == 0x80) ++at;
  }
  const auto step = [&] {
    const bool newline = at < source.size() && source[at] == '\n';
    place.line += newline ? 1 : 0;
    place.column = newline ? 1 : place.column + 1;
    ++at;
  };
  // A bare word on the command line has no quotes; long strings have three and may start with a newline.
  const char quote = at < source.size() ? source[at] : ' ';
  if (quote == '"' || quote == '\'') {
    const bool three = source.compare(at, 3, std::string(3, quote)) == 0;
    for (int i = 0; i < (three ? 3 : 1); ++i) step();
    if (three && at < source.size() && source[at] == '\n') step();
  }
  for (int i = 0; i < position; ++i) step();
  return place;
}

}  // namespace freshet::input
