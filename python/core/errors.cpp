#include "python/core/errors.hpp"

#include <exception>

#include <pybind11/pybind11.h>

#include "hiac/base/error.hpp"
#include "hiac/base/progress.hpp"

namespace hiac::python {
namespace {

namespace py = pybind11;

const char* class_of(const Error& error) {
  switch (error.exit_code()) {
    case ExitCode::usage:
      return "UsageError";
    case ExitCode::input:
      return "InputError";
    case ExitCode::judgement:
      return "JudgementError";
    default:
      return "Error";
  }
}

void raise(const char* name, const char* message) {
  const py::object type = py::module_::import("hiac.errors").attr(name);
  PyErr_SetString(type.ptr(), message);
}

}  // namespace

void register_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(class_of(error), error.what());
    } catch (const Cancelled& cancelled) {
      raise("Cancelled", cancelled.what());
    }
  });
}

}  // namespace hiac::python
