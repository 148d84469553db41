#include "cellgrid/types.hpp"

namespace freshet {

template <class T>
Field<T>::Field(const std::string& label, size_t values) : View(label, values) {}

template class Field<double>;
template class Field<int>;

}  // namespace freshet
