// The observers of a run.
#pragma once
#include <memory>

#include "src/run/observe/observer.hpp"

namespace freshet {

using Observers = std::vector<std::unique_ptr<Observer>>;

// Those that the scene asks for.
Observers make_observers(const Scene& scene, const std::string& directory);
// What they may leave in that directory, whatever the scene.
std::vector<std::string> observed_files();

// The one of this class, or nullptr.
template <class One>
const One* find(const Observers& observers) {
  for (const auto& observer : observers)
    if (const auto* one = dynamic_cast<const One*>(observer.get())) return one;
  return nullptr;
}

}  // namespace freshet
