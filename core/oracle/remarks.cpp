#include "core/oracle/remarks.h"

#include <algorithm>

namespace subdivd::oracle {

void remark_exceptions(const std::vector<LevelReport>& levels, std::vector<std::string>& remarks) {
  for (const LevelReport& level : levels)
    for (const Deviation& deviation : level.deviations) {
      if (deviation.exception.empty()) continue;
      const char* how_many = deviation.compared > 0 ? ": left out: " : ": left out, all of them: ";
      const std::string remark = deviation.quantity + how_many + deviation.exception;
      if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) remarks.push_back(remark);
    }
}

void remark_remoteness(const std::string& what, double remoteness, std::vector<std::string>& remarks) {
  if (remoteness > 1)
    remarks.push_back("the " + what +
                      " lies far from the origin for its size: coordinates round by their magnitude, so the "
                      "tolerance of positions is " +
                      std::to_string(remoteness) + " times as wide");
}

}  // namespace subdivd::oracle
