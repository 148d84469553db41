// Expressions in x and y [m], as scenes write beds, depths and velocities.
#pragma once
#include <string>

#include "src/scene/scene.hpp"
#include "src/scene/toml/diagnostics.hpp"

namespace freshet::input {

struct ExpressionError {
  int position;  // characters from the start of the expression
  std::string message, help;
};

// Variables x, y; constants pi, g; + - * / ^ ( ), comparisons, && ||, `a ? b : c`, sin cos tan asin acos atan
// atan2 sinh cosh tanh exp ln log10 sqrt abs min max sign rint. Compiled once. The function keeps its own x
// and y: call it from one thread at a time. Throws ExpressionError.
Function compile_expression(const std::string& text, double gravity);

// Where the character `position` of a TOML string stands, given where the string's opening quote stands.
Place place_in_string(const std::string& source, const Place& string, int position);

}  // namespace freshet::input
