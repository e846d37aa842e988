// Sums first, then divided; every number of a table can be had again from the rows of results.csv.
#include "app/bench/AoTable.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

namespace crevice {
namespace {

/// A mean of what is known.
class Mean {
public:
    void add(double value) {
        if (!std::isfinite(value)) return;
        sum_ += value;
        ++count_;
    }
    double value() const { return count_ > 0 ? sum_ / count_ : kUnknown; }

private:
    double sum_ = 0;
    int count_ = 0;
};

double known(const RegionError& region) { return region.count > 0 ? region.rmse : kUnknown; }

AoMean meanOf(const std::vector<const AoRow*>& rows) {
    AoMean mean;
    const auto over = [&](auto value) {
        Mean sum;
        for (const AoRow* row : rows) sum.add(value(*row));
        return sum.value();
    };
    mean.technique = rows.front()->technique;
    mean.quality = rows.front()->quality;
    mean.extras = rows.front()->extras;
    mean.label = rows.front()->label();
    mean.rows = static_cast<int>(rows.size());
    mean.rmse = over([](const AoRow& r) { return r.metrics.all.rmse; });
    mean.ofWhite = over([](const AoRow& r) { return r.metrics.all.ofWhite; });
    mean.mae = over([](const AoRow& r) { return r.metrics.all.mae; });
    mean.bias = over([](const AoRow& r) { return r.metrics.all.bias; });
    mean.absBias = over([](const AoRow& r) { return std::abs(r.metrics.all.bias); });
    mean.p95 = over([](const AoRow& r) { return r.metrics.all.p95; });
    mean.ssim = over([](const AoRow& r) { return r.metrics.ssim; });
    mean.correlation = over([](const AoRow& r) { return r.metrics.all.correlation; });
    mean.skill = over([](const AoRow& r) { return r.metrics.all.skill; });
    mean.noise = over([](const AoRow& r) { return r.metrics.noise; });
    mean.edge = over([](const AoRow& r) { return known(r.metrics.edge); });
    mean.border = over([](const AoRow& r) { return known(r.metrics.border); });
    mean.contact = over([](const AoRow& r) { return known(r.metrics.contact); });
    mean.slope = over([](const AoRow& r) { return r.metrics.all.slope; });
    mean.offset = over([](const AoRow& r) { return r.metrics.all.offset; });
    mean.fitRmse = over([](const AoRow& r) { return r.metrics.all.fitRmse; });
    mean.taps = rows.front()->taps;
    mean.tapsPerPixel = rows.front()->tapsPerPixel;
    mean.denoiseTaps = rows.front()->denoiseTaps;
    return mean;
}

/// 0.0125 → "1/80".
std::string shareText(double share) {
    const double parts = 1 / share;
    return std::abs(parts - std::round(parts)) < 1e-6 ? fmt::format("1/{:.0f}", parts) : fmt::format("{:.4g}", share);
}

std::set<double> listShares(const std::vector<AoRow>& rows) {
    std::set<double> shares;
    for (const AoRow& row : rows) shares.insert(row.share);
    return shares;
}

}  // namespace

std::string AoGroup::title() const {
    std::string text = !scene.empty()   ? scene
                       : kind.empty()   ? "all scenes"
                       : kind == "room" ? "rooms"
                                        : "thin occluders";
    if (!set.empty()) text += ", " + set + " views";
    text += share > 0 ? ", radius " + shareText(share) + " of the diagonal" : ", all radii";
    return text + (size.x > 0 ? fmt::format(", {}x{}", size.x, size.y) : "");
}

bool AoGroup::contains(const AoRow& row) const {
    return (size.x == 0 || row.size == size) && (kind.empty() || row.kind == kind) && (set.empty() || row.set == set) &&
           (scene.empty() || row.scene == scene) && (share <= 0 || row.share == share);
}

std::vector<AoMean> meanRows(const std::vector<AoRow>& rows, const AoGroup& group) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const AoRow*>> byCase;
    for (const AoRow& row : rows) {
        if (!group.contains(row)) continue;
        std::vector<const AoRow*>& list = byCase[row.label()];
        if (list.empty()) order.push_back(row.label());
        list.push_back(&row);
    }
    std::vector<AoMean> means;
    const auto white = byCase.find("white");
    for (const std::string& label : order) {
        const std::vector<const AoRow*>& list = byCase[label];
        if (white != byCase.end() && list.size() != white->second.size()) continue;
        means.push_back(meanOf(list));
    }
    addCosts(means, rows);
    markFront(means);
    return means;
}

void addCosts(std::vector<AoMean>& means, const std::vector<AoRow>& rows) {
    for (AoMean& mean : means) {
        Mean share, guard;
        for (const AoRow& row : rows) {
            if (row.label() != mean.label) continue;
            share.add(row.cpuShare);
            guard.add(row.guardShare);
        }
        mean.cpuShare = share.value();
        mean.guardShare = guard.value();
    }
}

void markFront(std::vector<AoMean>& means) {
    const auto beats = [](const AoMean& a, const AoMean& b) {
        return a.ofWhite <= b.ofWhite && a.cpuShare <= b.cpuShare && (a.ofWhite < b.ofWhite || a.cpuShare < b.cpuShare);
    };
    for (AoMean& mean : means) {
        mean.onFront = std::isfinite(mean.cpuShare) && mean.technique != "white" && mean.technique != "baked" &&
                       std::none_of(means.begin(), means.end(), [&](const AoMean& other) {
                           return other.technique != "white" && beats(other, mean);
                       });
    }
}

double middleShare(const std::vector<AoRow>& rows) {
    const std::set<double> shares = listShares(rows);
    return shares.empty() ? 0 : *std::next(shares.begin(), static_cast<std::ptrdiff_t>(shares.size() / 2));
}

std::vector<AoGroup> listGroups(const std::vector<AoRow>& rows) {
    const std::size_t shares = listShares(rows).size();
    std::vector<AoGroup> groups;
    const auto add = [&](AoGroup group) {
        if (std::any_of(rows.begin(), rows.end(), [&](const AoRow& row) { return group.contains(row); }))
            groups.push_back(std::move(group));
    };
    std::vector<std::string> scenes;
    std::vector<glm::uvec2> sizes;
    for (const AoRow& row : rows) {
        if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end()) scenes.push_back(row.scene);
        if (std::find(sizes.begin(), sizes.end(), row.size) == sizes.end()) sizes.push_back(row.size);
    }
    for (const glm::uvec2& size : sizes) {
        for (const double share : {middleShare(rows), 0.0}) {
            if (share <= 0 && shares < 2) continue;
            for (const std::string kind : {"room", "thin"}) {
                for (const std::string set : {"evaluation", "calibration"}) add({size, kind, set, "", share});
            }
        }
        for (const std::string& scene : scenes) add({size, "", "", scene, middleShare(rows)});
    }
    return groups;
}

}  // namespace crevice
