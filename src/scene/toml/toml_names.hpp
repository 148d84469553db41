// The classes of toml++ 3 by name: its header alone compiles longer than an average source of ours does.
#pragma once

namespace toml {
inline namespace v3 {
class array;
class node;
class table;
struct source_region;
}  // namespace v3
}  // namespace toml
