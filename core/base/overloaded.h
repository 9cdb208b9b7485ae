#pragma once
// Several lambdas as one visitor of a std::variant: the compiler finds the alternative that none of them
// takes.

namespace subdivd {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace subdivd
