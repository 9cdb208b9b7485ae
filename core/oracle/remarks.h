#pragma once
// What a report says about its comparison in words.

#include <string>
#include <vector>

#include "core/oracle/report.h"

namespace subdivd::oracle {

// One remark for every reason for which something was left out, however many levels name it.
void remark_exceptions(const std::vector<LevelReport>& levels, std::vector<std::string>& remarks);

// `what`: "mesh", "curve", "surface". `remoteness`: PointScale's; says nothing when it is 1.
void remark_remoteness(const std::string& what, double remoteness, std::vector<std::string>& remarks);

}  // namespace subdivd::oracle
