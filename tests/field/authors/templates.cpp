// SPDX-License-Identifier: MIT
// C++: VFRICTION, templates, std::vector, lambda, static state, exceptions, namespace, reference arguments, macro for the precision
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>
#include <omi_for_c.h>
#ifdef USUB_SINGLE
typedef float real;
#else
typedef double real;
#endif
namespace {
std::map<std::string, long> visits;
template <typename T, int N> class Law {
  std::vector<T> p;
public:
  Law(const T *props, int n) : p(props, props + n) {
    if (n < N) throw std::invalid_argument("the law needs " + std::to_string(N) + " properties, got " + std::to_string(n));
  }
  T operator()(T normal, T area) const { return p.at(0) * normal / (1 + p.at(1) * normal / area); }
};
std::string trimmed(const char *name) {
  std::string text(name, 80);
  return text.erase(text.find_last_not_of(' ') + 1);
}
}
extern "C" {
void FOR_NAME(vfriction, VFRICTION)(real *fTangential, real *state, const int &nBlock, const int &nBlockAnal,
    const int &nBlockEdge, const int &nNodState, const int &nNodSec, const int &nNodMain, const int &nFricDir,
    const int &nDir, const int &nStates, const int &nProps, const int &nTemp, const int &nFields, const int jFlags[3],
    const real rData[4], const char *surfInt, const char *surfSec, const char *surfMain, const int *jConSecUid,
    const int *jConMainUid, const real *props, const real *dSlipFric, const real *fStickForce, const real *fTangPrev,
    const real *fNormal, const real *areaCont, const real *dircosN, const real *dircosSl, const real *shapeSec,
    const real *shapeMain, const real *coordSec, const real *coordMain, const real *velSec, const real *velMain,
    const real *tempSec, const real *tempMain, const real *fieldSec, const real *fieldMain)
{
  if (nBlock == 0) return;
  std::string name = trimmed(surfInt);
  visits[name] += 1;
  if (name == "FORBIDDEN") throw std::runtime_error("interaction " + name + " has no law");
  const Law<real, 2> law(props, nProps);
  std::vector<real> force(nBlock);
  std::transform(fNormal, fNormal + nBlock, areaCont, force.begin(), [&](real n, real a) { return law(n, a); });
  for (int k = 0; k < nBlock; ++k)
    fTangential[k * nFricDir] = -std::min(force[k], fStickForce[k]);
}
}
