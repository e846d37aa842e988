// `crevice bench-ao`: its tables can be had again from its CSV, its page works in a browser, and what it refuses.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

#include "CliTools.h"
#include "core/Files.h"

namespace crevice::cli {
namespace {

using Json = nlohmann::json;
using Row = std::map<std::string, std::string>;

/// Two boxes on a floor, looked at from two places, in a list of views of their own.
constexpr const char* kScene = R"({
  "objects": [
    { "primitive": "plane", "size": [6, 6] },
    { "primitive": "box", "size": [1, 1, 1], "instances": [[-0.6, 0.5, 0], [0.6, 0.5, 0.3]] },
    { "primitive": "cylinder", "radius": 0.02, "height": 1, "position": [0, 0.5, 0.8], "array": { "count": [5, 1, 1], "step": [0.15, 1, 1] } }
  ] })";
constexpr const char* kViews = R"({
  "radii": [0.025, 0.05],
  "scenes": [
    { "name": "boxes", "file": "boxes.scene.json", "kind": "room",
      "lights": [{ "type": "directional", "direction": [0.3, -1, -0.4], "intensity": 2 }],
      "ambient": { "sky": [0.3, 0.3, 0.3], "ground": [0.1, 0.1, 0.1] },
      "views": [ { "name": "low", "set": "calibration", "eye": [2, 0.6, 2.2], "target": [0, 0.4, 0] },
                 { "name": "high", "set": "evaluation", "eye": [-1, 2, 2], "target": [0, 0.3, 0] } ] },
    { "name": "absent", "file": "absent.glb", "views": [ { "name": "a" } ] }
  ] })";
constexpr const char* kRun =
    "bench-ao -q --views views.json --techniques hbao,gtao --qualities fast,high --sizes 128x72 --study-size 64x36 "
    "--samples 32 --repeats 1 -o . --markdown table.md";

class BenchAoTest : public CliTest {
protected:
    void SetUp() override {
        CliTest::SetUp();
        write("boxes.scene.json", kScene);
        write("views.json", kViews);
    }

    void runOnce() {
        const Outcome outcome = run(kRun);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_NE(outcome.out.find("gtao high"), std::string::npos) << outcome.out;
    }

    std::vector<Row> readCsv() const {
        std::ifstream file(path("results.csv"));
        std::vector<Row> rows;
        std::vector<std::string> names;
        for (std::string line; std::getline(file, line);) {
            const std::vector<std::string> cells = splitCells(line);
            if (names.empty()) {
                names = cells;
                continue;
            }
            EXPECT_EQ(cells.size(), names.size()) << line;
            Row& row = rows.emplace_back();
            for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = cells[i];
        }
        return rows;
    }

    Json readJson() const { return Json::parse(readText(path("results.json"))); }

    /// What a browser makes of the page after `script` has run in it.
    std::string openPage(const std::string& script) const {
        std::string page = readText(path("index.html"));
        const std::string trap =
            "<script>window.faults = []; onerror = m => { faults.push(String(m)); };"
            "console.error = console.warn = m => faults.push(String(m));</script>";
        page.replace(page.find("<meta charset"), 0, trap);
        page += "<script>" + script + "</script>";
        std::ofstream(path("opened.html")) << page;
        const std::string command =
            "timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir=" +
            path("profile").string() + " --virtual-time-budget=5000 --dump-dom file://" + path("opened.html").string() +
            " 2>/dev/null";
        std::string dom;
        FILE* pipe = popen(command.c_str(), "r");
        char buffer[1 << 16];
        while (const std::size_t count = fread(buffer, 1, sizeof buffer, pipe)) dom.append(buffer, count);
        EXPECT_EQ(pclose(pipe), 0) << "is Debian's chromium installed? test.sh does that";
        return dom;
    }

private:
    static std::vector<std::string> splitCells(const std::string& line) {
        std::vector<std::string> cells(1);
        bool quoted = false;
        for (const char c : line) {
            if (c == '"')
                quoted = !quoted;
            else if (c == ',' && !quoted)
                cells.emplace_back();
            else
                cells.back() += c;
        }
        return cells;
    }
};

std::string labelOf(const Row& row) {
    std::string label = row.at("technique");
    for (const char* key : {"quality", "options"}) label += row.at(key).empty() ? "" : " " + row.at(key);
    return label;
}

bool belongs(const Row& row, const Json& table) {
    const double share = table["radius_share"];
    return (table["kind"] == "" || table["kind"] == row.at("kind")) &&
           (table["set"] == "" || table["set"] == row.at("set")) &&
           (table["scene"] == "" || table["scene"] == row.at("scene")) &&
           (share == 0 || share == std::stod(row.at("radius_share")));
}

/// Mean of the cells that are not empty; nothing known: NaN.
double meanOf(const std::vector<const Row*>& rows, const std::string& column) {
    double sum = 0;
    int count = 0;
    for (const Row* row : rows) {
        if (row->at(column).empty()) continue;
        sum += std::stod(row->at(column));
        ++count;
    }
    return count > 0 ? sum / count : std::nan("");
}

TEST_F(BenchAoTest, TablesAreMeansOfTheCsv) {
    runOnce();
    const std::vector<Row> rows = readCsv();
    ASSERT_EQ(rows.size(), 2u * 2u * (4u + 1u));  // views, radii, cases and white
    const Json json = readJson();
    EXPECT_EQ(json["rows"].size(), rows.size());
    std::size_t compared = 0, scenes = 0;
    for (const Json& table : json["tables"]) {
        scenes += table["scene"] != "";
        for (const Json& line : table["rows"]) {
            std::vector<const Row*> own, all;
            for (const Row& row : rows) {
                if (labelOf(row) != line["label"]) continue;
                all.push_back(&row);
                if (belongs(row, table)) own.push_back(&row);
            }
            ASSERT_EQ(own.size(), line["rows"].get<std::size_t>()) << table["title"] << line["label"];
            for (const char* column : {"rmse", "of_white", "mae", "bias", "p95", "ssim", "correlation", "skill",
                                       "noise", "edge", "border", "contact", "taps_per_pixel", "slope"}) {
                const double mean = meanOf(own, column);
                if (std::isnan(mean)) {
                    EXPECT_TRUE(line[column].is_null()) << column;
                    continue;
                }
                EXPECT_NEAR(line[column].get<double>(), mean, 1e-9) << column << " of " << line["label"];
                ++compared;
            }
            EXPECT_NEAR(line["cpu_share"].get<double>(), meanOf(all, "cpu_share"), 1e-9);
        }
    }
    EXPECT_EQ(scenes, 1u);
    EXPECT_GT(compared, 300u);
}

TEST_F(BenchAoTest, RowsAreWhatTheySay) {
    runOnce();
    for (const Row& row : readCsv()) {
        const auto number = [&](const char* column) { return std::stod(row.at(column)); };
        EXPECT_NEAR(number("of_white"), number("rmse") / number("white_rmse"), 1e-9);
        EXPECT_LT(number("excluded"), 0.002);
        EXPECT_LT(number("truth_noise"), 0.03);
        EXPECT_NEAR(number("radius") / number("radius_share"), 8.55, 0.05);  // of 6 x 1 x 6
        if (row.at("technique") == "white") {
            EXPECT_EQ(number("of_white"), 1);
            EXPECT_NEAR(number("bias"), number("mae"), 1e-9);
        } else {
            EXPECT_LT(number("of_white"), 0.9) << labelOf(row);
            EXPECT_GT(number("correlation"), 0.5) << labelOf(row);
        }
    }
    const Json json = readJson();
    ASSERT_EQ(json["calibration"].size(), 2u);
    for (const Json& fit : json["calibration"]) {
        EXPECT_EQ(fit["quality"], "high");
        EXPECT_LT(fit["fitted"].get<double>(), 1) << fit;
        EXPECT_GT(fit["matched"].get<double>(), 0) << fit;
    }
    EXPECT_EQ(json["split"].size(), 2u * 2u);  // views, techniques
    for (const Json& split : json["split"]) {
        const double total = split["total"], estimator = split["estimator"], missing = split["missing"];
        EXPECT_LE(total, estimator + missing + 1e-9) << "the triangle of errors does not close";
        EXPECT_GT(std::min(estimator, missing), 0);
    }
    const std::string table = readText(path("table.md"));
    EXPECT_NE(table.find("| white |"), std::string::npos);
    EXPECT_NE(table.find("crevice bench-ao --views views.json"), std::string::npos);
}

TEST_F(BenchAoTest, PageWorksInABrowser) {
    runOnce();
    const std::string page = readText(path("index.html"));
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    EXPECT_EQ(page.find("<link"), std::string::npos);
    const std::string dom = openPage(readText(CREVICE_TEST_SOURCE_DIR "/tests/cli/bench-ao-page.js"));
    const std::size_t begin = dom.find("REPORT{"), end = dom.find("}END", begin);
    ASSERT_NE(begin, std::string::npos) << dom.substr(0, 2000);
    const Json report = Json::parse(dom.substr(begin + 6, end + 1 - begin - 6));
    EXPECT_EQ(report["faults"], Json::array());
    EXPECT_EQ(report["rows"], 5);
    EXPECT_TRUE(std::is_sorted(report["order"].begin(), report["order"].end())) << report;
    EXPECT_EQ(report["fits"], 2);
    EXPECT_EQ(report["splits"], 2);
    EXPECT_EQ(report["groups"], 5);
    EXPECT_EQ(report["points"], 4);
    EXPECT_EQ(report["painted"], Json({true, true, true}));
    EXPECT_GT(report["curve"], 0);
    EXPECT_GT(report["blurs"], 0);
    EXPECT_NE(report["before"], report["after"]);
    EXPECT_NE(report["after"].get<std::string>().find("20%"), std::string::npos) << report["after"];
    // Pictures: truth, then map and error of four cases; two lit ones with and without.
    EXPECT_EQ(report["images"], 1 + 2 * 4 + 2 * 2);
    EXPECT_TRUE(report["sized"]);

    // The front by hand: no other case is at most as wrong and at most as dear.
    const Json lines = readJson()["tables"][0]["rows"];
    std::vector<std::string> front;
    for (const Json& a : lines) {
        const auto beats = [&](const Json& b) {
            return b["label"] != "white" && b["label"] != a["label"] && b["of_white"] <= a["of_white"] &&
                   b["cpu_share"] <= a["cpu_share"];
        };
        if (a["label"] != "white" && std::none_of(lines.begin(), lines.end(), beats)) front.push_back(a["label"]);
    }
    EXPECT_FALSE(front.empty());
    for (const char* key : {"front", "marked"}) {
        std::vector<std::string> shown = report[key];
        std::sort(shown.begin(), shown.end());
        std::sort(front.begin(), front.end());
        EXPECT_EQ(shown, front) << key;
    }
}

TEST_F(BenchAoTest, MistakesAreNamed) {
    expectRefused("bench-ao crease", "no output given", "-o FOLDER");
    expectRefused("bench-ao crease -o gone/deeper", "-o: folder 'gone/deeper' cannot be made", "make its parent");
    expectRefused("bench-ao crease -o views.json", "-o: folder 'views.json' cannot be made", "one that is there");
    expectRefused("bench-ao crease -o . --techniques gtoa", "--techniques: there is no 'gtoa'", "did you mean 'gtao'?");
    expectRefused("bench-ao crease -o . --qualities hihg", "--qualities: there is no 'hihg'", "did you mean 'high'?");
    expectRefused("bench-ao crease -o . --variant vbao", "--variant: 'vbao' names no technique and preset",
                  "\"vbao high");
    expectRefused("bench-ao crese -o .", "no scene named 'crese'", "did you mean 'crease'?");
    expectRefused("bench-ao crease -o . --radii 1/0", "--radii: '1/0' is out of range", "1/80,1/40");
    expectRefused("bench-ao crease -o . --samples 1", "--samples: '1' is out of range", "from 2");
    write(
        "bad.json",
        R"({ "radii": [2], "scenes": [ { "name": "a", "file": "boxes.scene.json", "views": [ { "sett": "x" } ] } ] })");
    expectRefused("bench-ao -o . --views bad.json", "a radius must be a number above 0", "shares");
    expectRefused("bench-ao -o . --views bad.json", "unknown key 'sett' in a view", "did you mean 'set'");
    write("kept.md", "my text\n");
    expectRefused("bench-ao crease -o . --markdown kept.md", "--markdown: the file has text but no marks",
                  "bench-ao: begin");
}

}  // namespace
}  // namespace crevice::cli
