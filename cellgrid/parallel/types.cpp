#include "cellgrid/parallel/types.hpp"

namespace freshet {

template <class T>
Field<T>::Field(const std::string& label, size_t values) : View(label, values) {}

#ifndef FRESHET_DEVICE
template <class T>
Field<T>::Field(const Field& other) noexcept : View(other) {}
template <class T>
Field<T>& Field<T>::operator=(const Field& other) noexcept {
  return View::operator=(other), *this;
}
template <class T>
Field<T>::~Field() = default;
#endif

template class Field<double>;
template class Field<int>;

}  // namespace freshet
