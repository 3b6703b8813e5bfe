#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "hiac/base/shared_array.hpp"

namespace hiac::python {

namespace py = pybind11;

/// A C-contiguous numpy array of exactly this type: what is given as anything else is converted.
template <typename T>
using Contiguous = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Keeps a Python object alive as long as C++ needs it, and releases it under the GIL, whichever
/// thread does so. Needs the GIL.
inline std::shared_ptr<const void> kept_alive(py::object object) {
  return {static_cast<const void*>(object.release().ptr()), [](const void* pointer) {
            if (Py_IsInitialized() == 0) return;  // the interpreter has ended: nothing to release
            const py::gil_scoped_acquire held;
            Py_DECREF(static_cast<PyObject*>(const_cast<void*>(pointer)));
          }};
}

/// The elements of a numpy array as a SharedArray of `T`, which has the size of `U`. Copies
/// nothing: the numpy array lives as long as they are used.
template <typename T, typename U>
SharedArray<T> shared(const Contiguous<U>& array) {
  static_assert(sizeof(T) == sizeof(U));
  const auto* data = reinterpret_cast<const T*>(array.data());
  return {std::span<const T>(data, static_cast<std::size_t>(array.size())), kept_alive(array)};
}

/// A read-only numpy array over memory that `owner` keeps alive. Copies nothing.
template <typename U>
py::array read_only(const U* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<U> array(std::move(shape), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// A read-only numpy array of a SharedArray's elements, as numbers of type `U`. Copies nothing.
template <typename U, typename T>
py::array view(const SharedArray<T>& array, std::vector<py::ssize_t> shape) {
  static_assert(sizeof(T) == sizeof(U));
  const py::capsule owner(new SharedArray<T>(array),
                          [](void* kept) { delete static_cast<SharedArray<T>*>(kept); });
  return read_only(reinterpret_cast<const U*>(array.data()), std::move(shape), owner);
}

}  // namespace hiac::python
