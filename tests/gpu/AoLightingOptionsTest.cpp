// How an occlusion map meets each kind of light, pixel by pixel against the formulas of docs/ao/light.md.
#include "AoLightingFixture.h"

namespace crevice {
namespace {

using Rgb = glm::dvec3;

Rgb rgb(const Image& image, std::uint32_t x, std::uint32_t y) { return Rgb(glm::vec3(image.at(x, y))); }

void expectNear(const Rgb& found, const Rgb& expected, double tolerance, const std::string& where) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], tolerance) << where << " channel " << c;
}

std::string pixelName(std::uint32_t x, std::uint32_t y) { return std::to_string(x) + "," + std::to_string(y); }

TEST_F(AoLightingOptions, TheMapOfTheTestHoldsEverything) {
    const FloatMap map(openness(ambientLit()));
    EXPECT_EQ(map.min(), 0);
    EXPECT_EQ(map.max(), 1);
    EXPECT_NEAR(map.mean(), 0.5, 0.05);
}

TEST_F(AoLightingOptions, DirectLightAloneIsNeverTouchedByDefault) {
    const Image without = lit(sunlit(), {}, false);
    EXPECT_GT(FloatMap(without).max(), 0.1f);
    const std::vector<Options> all = {{},
                                      {{"multiBounce", "true"}},
                                      {{"specularOcclusion", "off"}},
                                      {{"specularOcclusion", "cone"}},
                                      {{"materialOcclusion", "product"}},
                                      {{"materialOcclusion", "screen"}}};
    for (const Options& options : all) EXPECT_EQ(lit(sunlit(), options), without);
}

TEST_F(AoLightingOptions, DirectStrengthScalesDirectLightByItsFormula) {
    const Image without = lit(sunlit(), {}, false);
    const Image map = openness(sunlit());
    for (const char* strength : {"0.25", "1"}) {
        const double s = std::stod(strength);
        const Image with = lit(sunlit(), {{"directStrength", strength}});
        eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
            const Rgb expected = rgb(without, x, y) * (1 - s * (1 - double(map.at(x, y).x)));
            expectNear(rgb(with, x, y), expected, 1e-6, std::string(strength) + " at " + pixelName(x, y));
        });
        EXPECT_NE(with, without);
    }
}

TEST_F(AoLightingOptions, DiffuseAmbientLightIsScaledByTheOpenness) {
    // Reflections stay as they are: what is left of the difference is diffuse light.
    const Options options{{"specularOcclusion", "off"}};
    const Image white = lit(ambientLit(), options, false);
    const Image map = openness(ambientLit());
    const Image with = lit(ambientLit(), options);
    loadLighting(options);
    const Image albedo = target(view_, "cc_gbuffer_albedoMap");
    const Image normalMetallic = target(view_, "cc_gbuffer_normalMap");
    eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
        const Rgb diffuse = rgb(albedo, x, y) * (1 - double(normalMetallic.at(x, y).w)) * Rgb(0.8f, 0.9f, 1.1f);
        const Rgb expected = rgb(white, x, y) - diffuse * (1 - double(map.at(x, y).x));
        expectNear(rgb(with, x, y), expected, 1e-6, pixelName(x, y));
    });
}

/// The cubic of Jimenez et al. 2016 in powers of the albedo: rows are the powers of the openness A³, A², A.
double bounced(double a, double albedo) {
    const double cubic[3][2] = {{2.0404, -0.3324}, {-4.7951, 0.6417}, {2.7552, 0.6903}};
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (cubic[i][0] * albedo + cubic[i][1]) * std::pow(a, 3 - i);
    return std::min(1.0, std::max(a, sum));
}

TEST_F(AoLightingOptions, MultiBounceFollowsTheCubicPerChannel) {
    EXPECT_NEAR(bounced(0.5, 0.5), 0.680963, 1e-5);  // worked by hand
    EXPECT_NEAR(bounced(0.5, 1), 0.8979, 1e-6);
    EXPECT_EQ(bounced(0.5, 0), 0.5);
    const Options off{{"specularOcclusion", "off"}};
    const Options on{{"specularOcclusion", "off"}, {"multiBounce", "true"}};
    const Image white = lit(ambientLit(), off, false);
    const Image map = openness(ambientLit());
    const Image with = lit(ambientLit(), on);
    loadLighting(on);
    const Image albedo = target(view_, "cc_gbuffer_albedoMap");
    const Image normalMetallic = target(view_, "cc_gbuffer_normalMap");
    double brightened = 0;
    eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
        const double a = double(map.at(x, y).x);
        const Rgb scattered = rgb(albedo, x, y) * (1 - double(normalMetallic.at(x, y).w));
        const Rgb share(bounced(a, scattered.x), bounced(a, scattered.y), bounced(a, scattered.z));
        const Rgb diffuse = scattered * Rgb(0.8f, 0.9f, 1.1f);
        expectNear(rgb(with, x, y), rgb(white, x, y) - diffuse * (1.0 - share), 2e-6, pixelName(x, y));
        brightened = std::max(brightened, share.x - share.z);
    });
    EXPECT_GT(brightened, 0.1) << "the crevices of an orange surface turn orange";
    // Where nothing is hidden nothing bounces: the very same bytes.
    EXPECT_EQ(lit(ambientLit(), on, false), white);
}

TEST_F(AoLightingOptions, TheMaterialsOwnOcclusionJoinsByRule) {
    const Scene plane = facingPlane({0.5f, 0.5f, 0.5f}, 0, 1);
    const double radiance = 1, albedo = 0.5;
    struct Case {
        int material, screen;
        const char* rule;
        double joined;
    };
    const Case cases[] = {{75, 50, "min", 0.5},       {25, 50, "min", 0.25},   {75, 50, "product", 0.375},
                          {25, 50, "product", 0.125}, {75, 50, "screen", 0.5}, {25, 50, "screen", 0.5}};
    for (const Case& c : cases) {
        const Options options{{"materialOcclusion", c.rule}, {"specularOcclusion", "off"}};
        setOpenness(c.screen);
        const double open = lit(plane, options, false).at(9, 9).x;
        setOpenness(c.screen, c.material);
        const double found = lit(plane, options).at(9, 9).x;
        // Roughness 1: reflections of a dull surface follow the material's openness to 1e-5.
        const double specular = (open - albedo * radiance) * c.material / 100;
        EXPECT_NEAR(found - specular, albedo * radiance * c.joined, 2e-5) << c.rule << ' ' << c.material;
    }
}

TEST_F(AoLightingOptions, ReflectionsOfAMetalFollowTheChosenFormula) {
    // Seen straight, n·v = 1; a metal sends nothing but reflections.
    for (const float roughness : {0.25f, 0.6f, 1.0f}) {
        const Scene plane = facingPlane({0.9f, 0.6f, 0.3f}, 1, roughness);
        const Image white = lit(plane, {{"specularOcclusion", "off"}}, false);
        const Image map = openness(plane);
        EXPECT_EQ(lit(plane, {{"specularOcclusion", "off"}}), white);
        const Image lagarde = lit(plane, {{"specularOcclusion", "lagarde"}});
        const Image cone = lit(plane, {{"specularOcclusion", "cone"}});
        const double r = double(target(view_, "cc_gbuffer_positionMap").at(9, 9).w);
        EXPECT_NEAR(r, double(roughness), 5e-4) << "half floats";
        eachPixel(map, [&](std::uint32_t x, std::uint32_t y) {
            const double a = double(map.at(x, y).x);
            const std::string where = std::to_string(roughness) + " at " + pixelName(x, y);
            const double exponent = std::exp2(-16 * r - 1);
            const double byLagarde = std::clamp(std::pow(1 + a, exponent) - 1 + a, 0.0, 1.0);
            expectNear(rgb(lagarde, x, y), rgb(white, x, y) * byLagarde, 2e-5, "lagarde " + where);
            // Both cones lie around the normal: the smaller is the overlap.
            const double byCone = std::min(1.0, (1 - std::sqrt(1 - a)) / (1 - std::exp2(-3.32193 * r * r)));
            expectNear(rgb(cone, x, y), rgb(white, x, y) * byCone, 3e-4, "cone " + where);
        });
    }
}

TEST_F(AoLightingOptions, ConesDarkenSteadilyAndKeepAnOpenSurface) {
    for (const char* rule : {"lagarde", "cone"}) {
        const Options options{{"specularOcclusion", rule}};
        const Image white = lit(ambientLit(), {{"specularOcclusion", "off"}}, false);
        Image before = lit(ambientLit(), options, false);
        eachPixel(white, [&](std::uint32_t x, std::uint32_t y) {
            expectNear(rgb(before, x, y), rgb(white, x, y), 1e-5, std::string(rule) + " open " + pixelName(x, y));
        });
        for (const int open : {90, 60, 30, 5, 0}) {
            setOpenness(open);
            const Image darker = lit(ambientLit(), options);
            eachPixel(darker, [&](std::uint32_t x, std::uint32_t y) {
                ASSERT_LE(darker.at(x, y).x, before.at(x, y).x + 1e-6f)
                    << rule << ' ' << open << ' ' << pixelName(x, y);
            });
            before = darker;
        }
        EXPECT_LE(FloatMap(before).max(), 1e-4f) << rule << ": a closed surface reflects nothing";
    }
}

TEST_F(AoLightingOptions, EmissionIsNeverScaled) {
    Scene scene = room();
    for (SceneMaterial& material : scene.materials) material.emissive = {0.5f, 0.25f, 0.1f};
    const Image without = lit(scene, {}, false);
    EXPECT_NEAR(FloatMap(without).max(), 0.5f, 1e-3f);
    for (const char* applyTo : {"ambient", "albedo"})
        EXPECT_EQ(lit(scene, {{"applyTo", applyTo}, {"directStrength", "1"}, {"multiBounce", "true"}}), without)
            << applyTo;
}

TEST_F(AoLightingOptions, FogIsNeverScaled) {
    Scene dark = room();
    dark.fog.type = FogType::Exp;
    dark.fog.density = 0.2f;
    dark.fog.color = {0.4f, 0.5f, 0.6f};
    const Options options{{"directStrength", "1"}, {"specularOcclusion", "off"}};
    const Image fog = lit(dark, options, false);
    EXPECT_GT(FloatMap(fog).min(), 0.1f);
    EXPECT_EQ(lit(dark, options), fog) << "a dark scene shows fog alone";
    Scene bright = sunlit();
    bright.fog = dark.fog;
    const Image without = lit(bright, options, false);
    const Image with = lit(bright, options);
    const Image map = openness(bright);
    eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
        const Rgb shown = rgb(without, x, y) - rgb(fog, x, y);
        expectNear(rgb(with, x, y) - rgb(fog, x, y), shown * double(map.at(x, y).x), 2e-6, pixelName(x, y));
    });
}

TEST_F(AoLightingOptions, TransparentSurfacesAndSkyAreNotDarkened) {
    Scene scene = ambientLit();
    // No wall: sky is in the frame. Glass before the box, opaque on the left and half on the right.
    scene.instances.erase(scene.instances.begin() + 1);
    scene.instances[0].world = scene.instances[0].world * glm::mat4(0.1f);
    scene.sky.enabled = true;
    for (const float alpha : {1.0f, 0.5f}) {
        SceneMaterial glass;
        glass.baseColor = {0.2f, 0.7f, 0.4f, alpha};
        glass.metallic = 0;
        glass.doubleSided = true;
        glass.alphaMode = AlphaMode::Blend;
        scene.materials.push_back(glass);
    }
    const glm::vec3 toCamera = glm::normalize(glm::vec3(3.6f, 3.6f, 2.6f));
    addSquare(scene, glm::vec3(0.6f, 0.9f, 0.1f) + toCamera, toCamera, 0.5f, 2);
    addSquare(scene, glm::vec3(1.0f, 0.2f, 0.9f) + toCamera, toCamera, 0.5f, 3);
    setOpenness(0);
    const Image without = lit(scene, {}, false);
    const Image with = lit(scene, {});
    const FloatMap depth(target(view_, "viewDepth"));
    Scene bare = scene;
    bare.instances.resize(scene.instances.size() - 2);
    const Image behindWithout = lit(bare, {}, false);
    const Image behindWith = lit(bare, {});
    int sky = 0, opaque = 0, half = 0;
    eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
        const Rgb change = rgb(without, x, y) - rgb(with, x, y);
        const Rgb behind = rgb(behindWithout, x, y) - rgb(behindWith, x, y);
        const bool isSky = depth.at(x, y) > 1e8f;
        const bool hasGlass = rgb(without, x, y) != rgb(behindWithout, x, y);
        if (isSky) expectNear(change, Rgb(0), 0, "sky " + pixelName(x, y));
        if (isSky || !hasGlass) {
            sky += isSky;
            return;
        }
        const double seen = change.x / behind.x;  // share of what is behind
        ASSERT_TRUE(std::abs(seen) < 1e-5 || std::abs(seen - 0.5) < 1e-3) << seen << " at " << pixelName(x, y);
        ++(seen < 0.25 ? opaque : half);
    });
    EXPECT_GT(sky, 50);
    EXPECT_GT(opaque, 20);
    EXPECT_GT(half, 20);
}

TEST_F(AoLightingOptions, AmbientLightIsLookedUpAlongTheBentNormal) {
    // Radiance differs by height: that along a direction d is its share of sky, (d.y + 1) / 2.
    Scene scene = room();
    scene.ambient = Ambient{glm::vec3(1.0f, 0.9f, 0.8f), glm::vec3(0.1f, 0.2f, 0.3f)};
    const Rgb sky(1.0f, 0.9f, 0.8f), ground(0.1f, 0.2f, 0.3f);
    const Options options{{"specularOcclusion", "off"}};
    const Image along = lit(scene, options);
    const Image map = openness(scene);
    loadLighting(options);
    const Image albedo = target(view_, "cc_gbuffer_albedoMap");
    const Image normalMetallic = target(view_, "cc_gbuffer_normalMap");
    // (0.6, 0.8, 0), not of unit length, where the bent normal is known; 0 elsewhere.
    setBentNormal(true);
    const Image bent = lit(scene, options);
    int known = 0;
    eachPixel(bent, [&](std::uint32_t x, std::uint32_t y) {
        const glm::dvec4 n = normalMetallic.at(x, y);
        const Rgb scattered = rgb(albedo, x, y) * (1 - n.w) * double(map.at(x, y).x);
        const double normalShare = glm::normalize(glm::dvec3(n)).y * 0.5 + 0.5;
        const double share = x % 2 == 0 ? 0.9 : normalShare;
        const Rgb expected = rgb(along, x, y) + scattered * (sky - ground) * (share - normalShare);
        expectNear(rgb(bent, x, y), expected, 1e-3, pixelName(x, y));
        known += std::abs(share - normalShare) > 0.1;
    });
    EXPECT_GT(known, 200);
}

TEST_F(AoLightingOptions, ConesLieAroundTheBentNormal) {
    // A smooth metal seen straight mirrors along its normal; the open cone points 53 degrees aside.
    const Scene plane = facingPlane({0.9f, 0.6f, 0.3f}, 1, 0.1f);
    setOpenness(36);  // cos of the half-angle 0.8: 37 degrees
    setBentNormal(true);
    const Image image = lit(plane, {{"specularOcclusion", "cone"}});
    EXPECT_EQ(image.at(8, 8).x, 0) << "the mirrored cone is outside";
    EXPECT_GT(image.at(9, 8).x, 0.3f) << "no bent normal: around the normal, inside";
}

TEST_F(AoLightingOptions, BlinnPhongDarkensItsConstantAmbientLight) {
    const Scene dark = room();  // the chapter's ambient light comes without any light of the scene
    Options options{{"lighting", "blinn-phong"}, {"multiBounce", "true"}, {"specularOcclusion", "cone"}};
    const Image map = openness(dark);
    const Image white = lit(dark, options, false);
    const Image with = lit(dark, options);
    EXPECT_NEAR(FloatMap(white).max(), FloatMap(white).min(), 1e-6f) << "whatever the surface's colour";
    EXPECT_GT(FloatMap(white).min(), 0.01f);
    const Image sunWhite = lit(sunlit(), options, false);
    const Image sun = lit(sunlit(), options);
    options["directStrength"] = "0.5";
    const Image halfSun = lit(sunlit(), options);
    eachPixel(with, [&](std::uint32_t x, std::uint32_t y) {
        const double a = double(map.at(x, y).x);
        const Rgb ambient = rgb(white, x, y), direct = rgb(sunWhite, x, y) - ambient;
        expectNear(rgb(with, x, y), ambient * a, 1e-6, "ambient " + pixelName(x, y));
        expectNear(rgb(sun, x, y), ambient * a + direct, 1e-6, "direct " + pixelName(x, y));
        expectNear(rgb(halfSun, x, y), ambient * a + direct * (0.5 + 0.5 * a), 1e-6, "half " + pixelName(x, y));
    });
}

TEST_F(AoLightingOptions, OnAlbedoNoOtherOptionCounts) {
    Scene scene = sunlit();
    scene.ambient = Ambient{glm::vec3(0.3f), glm::vec3(0.2f)};
    const Image plain = lit(scene, {{"applyTo", "albedo"}});
    EXPECT_EQ(lit(scene, {{"applyTo", "albedo"}, {"directStrength", "1"}, {"multiBounce", "true"}}), plain);
    EXPECT_EQ(lit(scene, {{"applyTo", "albedo"}, {"specularOcclusion", "cone"}, {"materialOcclusion", "screen"}}),
              plain);
    EXPECT_NE(lit(scene, {{"applyTo", "albedo"}}, false), plain);
}

}  // namespace
}  // namespace crevice
