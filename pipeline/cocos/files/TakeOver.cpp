// An Error is never made of nothing.
#include "cocos/files/TakeOver.h"

#include <set>
#include <tuple>

namespace crevice::cocos {

void takeOver(const Problems& own, Problems& problems) {
    if (!own.all().empty()) problems.add(Error(own.all()));
}

void takeOverOnce(const Problems& own, Problems& problems) {
    std::set<std::tuple<std::string, int, int, std::string>> said;
    std::vector<Problem> once;
    for (const Problem& problem : own.all()) {
        const SourceLoc& at = problem.where;
        if (said.emplace(at.file, at.line, at.column, problem.message).second) once.push_back(problem);
    }
    if (!once.empty()) problems.add(Error(std::move(once)));
}

}  // namespace crevice::cocos
