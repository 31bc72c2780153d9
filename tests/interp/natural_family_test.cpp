// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// What the estimators that read the samples' Delaunay tessellation have in common, and how they differ.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "estimation.hpp"
#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"
#include "natural_neighbour_oracle.hpp"
#include "sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/error.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

const std::vector<std::string> family = {"natural", "natural:smooth", "laplace", "linear"};
const std::vector<std::string> by_distance = {"nearest", "idw", "kriging:nugget=0.1:sill=1:range=300:ratio3=1",
                                              "kriging:drift=linear:nugget=0:sill=1:range=300:ratio3=1"};

std::unique_ptr<Estimator> estimator_of(const std::string& spec, const std::vector<Vec3>& sites,
                                        const BarrierQuery* faults = nullptr) {
    return make_estimator(parse_estimator(spec), sites, faults);
}

template <typename Field>
double value(const Weights& weights, const std::vector<Vec3>& sites, Field field) {
    double sum = 0;
    for (const auto& [site, weight] : weights.terms) {
        sum += weight * field(sites[site]);
    }
    return sum;
}

double value(const Weights& weights, const std::vector<double>& values) {
    double sum = 0;
    for (const auto& [site, weight] : weights.terms) {
        sum += weight * values[site];
    }
    return sum;
}

std::vector<double> random_values(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<double> values(count);
    for (double& v : values) {
        v = random();
    }
    return values;
}

/// A sheet x = height(y, z) over the square [lo, hi]² by n × n squares, each of two triangles.
template <typename Height>
Barrier graph_over_yz(double lo, double hi, int n, Height height) {
    Barrier fault = fault_at_x(0, lo, hi);
    fault.sheet.vertices.clear();
    fault.sheet.triangles.clear();
    for (int j = 0; j <= n; ++j) {
        for (int k = 0; k <= n; ++k) {
            const double y = lo + (hi - lo) * j / n, z = lo + (hi - lo) * k / n;
            fault.sheet.vertices.push_back({height(y, z), y, z});
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < n; ++k) {
            const auto at = [&](int dj, int dk) { return static_cast<std::uint32_t>((j + dj) * (n + 1) + k + dk); };
            fault.sheet.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            fault.sheet.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return fault;
}

/// On which side of such a sheet: linear in its triangles, found without the code under test.
template <typename Height>
bool beyond_graph(const Vec3& p, double lo, double hi, int n, Height height) {
    const double step = (hi - lo) / n;
    const double j = std::floor((p.y - lo) / step), k = std::floor((p.z - lo) / step);
    const double u = (p.y - lo) / step - j, v = (p.z - lo) / step - k;
    const auto h = [&](double dj, double dk) { return height(lo + (j + dj) * step, lo + (k + dk) * step); };
    const double x = u >= v ? h(0, 0) + u * (h(1, 0) - h(0, 0)) + v * (h(1, 1) - h(1, 0))
                            : h(0, 0) + v * (h(0, 1) - h(0, 0)) + u * (h(1, 1) - h(0, 1));
    return p.x > x;
}

/// The fault y < 500 of the plane x = 500, through all z of interest.
Barrier half_fault() {
    Barrier fault = fault_at_x(500, -5000, 5000);
    for (Vec3& p : fault.sheet.vertices) {
        p.y = std::min(p.y, 500.0);
    }
    fault.spacing = 60;
    return fault;
}

/// The largest difference between neighbours of `steps` places on an arc round the half fault's end, from face to face.
double largest_step(const Estimator& estimator, const std::vector<double>& values, std::size_t steps) {
    std::vector<Vec3> arc;
    for (std::size_t i = 0; i <= steps; ++i) {
        const double angle =
            2 * std::numbers::pi * (0.001 + 0.998 * static_cast<double>(i) / static_cast<double>(steps));
        arc.push_back({500 + 90 * std::sin(angle), 500 - 90 * std::cos(angle), 480});
    }
    const auto weights = weights_at(estimator, arc);
    double largest = 0;
    for (std::size_t i = 1; i < arc.size(); ++i) {
        largest = std::max(largest, std::abs(value(weights[i], values) - value(weights[i - 1], values)));
    }
    return largest;
}

}  // namespace

TEST_CASE("Laplace weights equal those of CGAL's laplace_natural_neighbor_coordinates_3") {
    for (const auto& sites : {uniform_sites(2000, 11), borehole_sites(40, 50, 12)}) {
        const auto places = places_in({{250, 250, 250}, {750, 750, 750}}, 500, 13);
        const auto own = weights_at(*estimator_of("laplace", sites), places);
        const auto cgal = cgal_laplace_weights(sites, places);
        double worst = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (own[i].beyond == 0) {
                worst = std::max(worst, largest_difference(own[i].terms, cgal[i]));
            }
        }
        CHECK(worst <= 1e-9);
    }
}

TEST_CASE("Linear weights are the barycentric coordinates in the samples' Delaunay cells") {
    const auto sites = uniform_sites(2000, 14);
    const auto places = places_in({{150, 150, 150}, {850, 850, 850}}, 500, 15);
    const auto own = weights_at(*estimator_of("linear", sites), places);
    const auto exact = cgal_linear_weights(sites, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        REQUIRE(own[i].beyond == 0);
        REQUIRE(own[i].terms.size() <= 4);
        REQUIRE(largest_difference(own[i].terms, exact[i]) <= 1e-10);
    }
}

TEST_CASE("Linear fields are reproduced inside the hull by all that read the tessellation") {
    for (const auto& sites : {uniform_sites(2000, 21), borehole_sites(40, 50, 22), lattice_sites(10)}) {
        const Box3 box = bounding_box(sites);
        const double scale = 1 / box.diagonal();
        const auto field = [&](const Vec3& p) { return 2 + scale * (p.x - 0.7 * p.y + 0.3 * p.z); };
        auto places = places_in(box, 2000, 23);
        for (std::size_t i = 0; i + 1 < 400; ++i) {  // on edges, and at cubes' centres of the lattice
            places.push_back(0.5 * (sites[i] + sites[i + 1]));
            places.push_back(0.5 * (sites[i] + sites[(i + 111) % sites.size()]));
        }
        for (const auto& spec : family) {
            CAPTURE(spec);
            const auto weights = weights_at(*estimator_of(spec, sites), places);
            double worst = 0;
            std::size_t inside = 0;
            for (std::size_t i = 0; i < places.size(); ++i) {
                if (weights[i].beyond == 0) {
                    ++inside;
                    worst = std::max(worst, std::abs(value(weights[i], sites, field) - field(places[i])));
                }
            }
            CHECK(inside > 1000);
            CHECK(worst <= 1e-10);
        }
    }
}

TEST_CASE(
    "All but the smooth one stay within the range of the values; the smooth one is exact for spherical quadratics") {
    const auto sites = uniform_sites(3000, 31);
    const auto places = places_in({{300, 300, 300}, {700, 700, 700}}, 1000, 32);
    const auto field = [](const Vec3& p) { return 1 + 1e-3 * p.y + 1e-6 * squared_length(p - Vec3{400, 500, 600}); };
    const auto worst_of = [&](const std::string& spec) {
        const auto weights = weights_at(*estimator_of(spec, sites), places);
        double worst = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            worst = std::max(worst, std::abs(value(weights[i], sites, field) - field(places[i])));
            for (const auto& term : weights[i].terms) {
                REQUIRE((spec == "natural:smooth" || term.weight >= 0));
            }
        }
        return worst;
    };
    CHECK(worst_of("natural") > 1e-4);
    CHECK(worst_of("laplace") > 1e-4);
    CHECK(worst_of("linear") > 1e-4);
    CHECK(worst_of("natural:smooth") <= 1e-10);
}

TEST_CASE("The smooth estimate has no kink at a sample, the plain one has") {
    const auto sites = uniform_sites(2000, 41);
    const auto values = random_values(sites.size(), 42);
    const auto kink_of = [&](const std::string& spec) {
        const auto estimator = estimator_of(spec, sites);
        double kinks = 0;
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < sites.size() && count < 50; ++i) {
            if (!Box3{{300, 300, 300}, {700, 700, 700}}.contains(sites[i])) {
                continue;
            }
            ++count;
            const double h = 0.05;  // sites are some 40 apart
            const auto w = weights_at(*estimator, {sites[i] - Vec3{h, 0, 0}, sites[i] + Vec3{h, 0, 0}});
            kinks += std::abs((value(w[1], values) - values[i]) / h - (values[i] - value(w[0], values)) / h);
        }
        return kinks / static_cast<double>(count);
    };
    const double plain = kink_of("natural"), smooth = kink_of("natural:smooth");
    INFO(plain << " and " << smooth);
    CHECK(smooth < 0.05 * plain);
}

TEST_CASE("The smooth estimate takes no slope from twin samples a hair apart") {
    // A wedged hole shares the upper part of its parent: the same places but for rounding, other values.
    auto sites = borehole_sites(30, 20, 91);
    const auto plain = places_in({{100, 100, 100}, {900, 900, 900}}, 2000, 92);
    const auto largest_weight = [&] {
        double largest = 0;
        for (const auto& w : weights_at(*estimator_of("natural:smooth", sites), plain)) {
            double sum = 0;
            for (const auto& term : w.terms) {
                sum += std::abs(term.weight);
            }
            largest = std::max(largest, sum);
        }
        return largest;
    };
    const double without = largest_weight();
    for (const double apart : {1e-12, 1e-6, 0.02}) {
        CAPTURE(apart);
        for (std::size_t i = 0; i < 10; ++i) {
            sites.push_back(sites[i] + Vec3{apart, -apart, 0});
        }
        CHECK(largest_weight() < 3 * without);
        sites.resize(600);
    }
}

TEST_CASE("E1: nothing across a through-going, a curved or two crossing faults has any weight") {
    const auto sites = uniform_sites(600, 51);
    const auto places = places_in({{-100, -100, -100}, {1100, 1100, 1100}}, 100'000, 52);
    const auto bowl = [](double y, double z) {
        return 350 + 3e-4 * ((y - 500) * (y - 500) + (z - 400) * (z - 400)) + 60 * std::sin(y / 90);
    };
    struct Case {
        std::string name;
        std::vector<Barrier> faults;
        std::function<int(const Vec3&)> block;
    };
    Barrier across = fault_at_x(0, -2000, 3000);
    for (Vec3& p : across.sheet.vertices) {
        p = {p.y, 520, p.z};
    }
    const std::vector<Case> cases = {
        {"through-going", {fault_at_x(500, -2000, 3000)}, [](const Vec3& p) { return int(p.x > 500); }},
        {"curved",
         {graph_over_yz(-1500, 2500, 40, bowl)},
         [&](const Vec3& p) { return int(beyond_graph(p, -1500, 2500, 40, bowl)); }},
        {"crossing", {fault_at_x(500, -2000, 3000), across}, [](const Vec3& p) {
             return 2 * int(p.x > 500) + int(p.y > 520);
         }}};
    for (const auto& [name, faults, block] : cases) {
        const BarrierQuery proximity(faults);
        auto everyone = family;
        everyone.insert(everyone.end(), by_distance.begin(), by_distance.end());
        everyone.emplace_back("natural:azimuth=30:dip=20:ratio2=0.5:ratio3=0.2");
        for (const auto& spec : everyone) {
            CAPTURE(name, spec);
            const auto weights = weights_at(*estimator_of(spec, sites, &proximity), places);
            std::size_t across_count = 0, empty = 0;
            double worst_sum = 0;
            for (std::size_t i = 0; i < places.size(); ++i) {
                double sum = 0;
                for (const auto& [site, weight] : weights[i].terms) {
                    across_count += block(sites[site]) != block(places[i]);
                    sum += weight;
                }
                empty += weights[i].terms.empty();
                worst_sum = std::max(worst_sum, std::abs(sum - 1));
            }
            CHECK(across_count == 0);
            CHECK(empty == 0);
            CHECK(worst_sum <= 1e-12);
        }
    }
}

TEST_CASE("E1: estimates are continuous round the end of a half fault") {
    const std::vector<Barrier> faults = {half_fault()};
    const BarrierQuery proximity(faults);
    const auto sites = uniform_sites(1500, 61);
    const auto values = random_values(sites.size(), 62);
    auto continuous = family;
    continuous.emplace_back("natural:azimuth=60:ratio3=0.3");
    for (const auto& spec : continuous) {
        const auto estimator = estimator_of(spec, sites, &proximity);
        const double coarse = largest_step(*estimator, values, 1000);
        const double fine = largest_step(*estimator, values, 32'000);
        INFO(spec << ": " << coarse << " at 1/1000 of the arc, " << fine << " at 1/32000");
        CHECK(fine < coarse / 10);
        const auto faces = weights_at(*estimator, {{499.9, 450, 480}, {500.1, 450, 480}});
        CHECK(std::abs(value(faces[0], values) - value(faces[1], values)) > 0.01);  // there is a barrier
    }
    // Those that choose sites by their distance jump, by as much however near the places.
    for (const auto& spec : by_distance) {
        const auto estimator = estimator_of(spec, sites, &proximity);
        const double jump = largest_step(*estimator, values, 32'000);
        const double without = largest_step(*estimator_of(spec, sites), values, 32'000);
        INFO(spec << ": " << jump << ", and " << without << " without the fault");
        CHECK(jump > 1e-3);
    }
}

TEST_CASE("With anisotropy they are what they are without among sites turned and stretched") {
    const auto sites = uniform_sites(800, 81);
    const auto places = places_in({{-100, -100, -100}, {1100, 1100, 1100}}, 2000, 82);
    const std::string options = ":azimuth=70:dip=25:roll=-15:ratio2=0.6:ratio3=0.15";
    const Metric metric({.azimuth_deg = 70, .dip_deg = 25, .roll_deg = -15, .ratio2 = 0.6, .ratio3 = 0.15});
    const auto moved = [&](std::vector<Vec3> points) {
        std::transform(points.begin(), points.end(), points.begin(), metric);
        return points;
    };
    for (const auto& spec : family) {
        CAPTURE(spec);
        const auto with = weights_at(*estimator_of(spec + options, sites), places);
        const auto without = weights_at(*estimator_of(spec, moved(sites)), moved(places));
        const auto plain = weights_at(*estimator_of(spec, sites), places);
        std::size_t different = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            REQUIRE(with[i].terms.size() == without[i].terms.size());
            REQUIRE(with[i].beyond == without[i].beyond);
            for (std::size_t k = 0; k < with[i].terms.size(); ++k) {
                REQUIRE(with[i].terms[k].site == without[i].terms[k].site);
                REQUIRE(with[i].terms[k].weight == without[i].terms[k].weight);
            }
            different += with[i].terms.size() != plain[i].terms.size() || with[i].beyond != plain[i].beyond;
        }
        CHECK(different > 200);
        // A linear field stays one, and a site has its own value.
        const auto linear = [](const Vec3& p) { return 1 + 0.2 * p.x - 0.3 * p.y + 0.1 * p.z; };
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (with[i].beyond == 0) {
                REQUIRE(value(with[i], sites, linear) == Approx(linear(places[i])).epsilon(1e-10).margin(1e-8));
            }
        }
        const auto on = weights_at(*estimator_of(spec + options, sites), {sites[17]}).front();
        REQUIRE(on.terms.size() == 1);
        CHECK(on.terms.front().site == 17);
    }
    CHECK_THROWS_AS(estimator_of("natural:ratio3=1e-30", sites), UsageError);
    // Neighbours in the last bit may be turned onto one place: refused, never two sites at one place.
    const std::vector<Vec3> close = {{1000, 1000, 0}, {1000, std::nextafter(1000.0, 2000.0), 0}, {0, 0, 0}};
    std::size_t refused = 0;
    for (int azimuth = 1; azimuth < 90; ++azimuth) {
        try {
            estimator_of("linear:ratio3=0.5:azimuth=" + std::to_string(azimuth), close);
        } catch (const UsageError&) {
            ++refused;
        }
    }
    CHECK(refused > 0);
    CHECK(refused < 89);
}

TEST_CASE("Few, collinear, coplanar and coincident-but-for-rounding sites give finite answers that sum to 1") {
    std::vector<Vec3> line, plane, close;
    for (int i = 0; i < 10; ++i) {
        line.push_back({i + 0.0, 2.0 * i, -i + 0.0});
        for (int j = 0; j < 10; ++j) {
            plane.push_back({double(i), double(j), 0.1 * i});
        }
        close.push_back({1 + i * 0x1p-52, 1, 1});
    }
    const std::vector<std::vector<Vec3>> cases = {{{5, 5, 5}},
                                                  {{0, 0, 0}, {2, 0, 0}},
                                                  {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                  {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                  {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                                                  line,
                                                  plane,
                                                  close};
    for (const auto& spec : family) {
        for (const auto& sites : cases) {
            CAPTURE(spec, sites.size());
            const auto estimator = estimator_of(spec, sites);
            auto places = places_in(bounding_box(sites).grown(3), 200, 71);
            places.insert(places.end(), sites.begin(), sites.end());
            const auto weights = weights_at(*estimator, places);
            for (std::size_t i = 0; i < places.size(); ++i) {
                double sum = 0, ones = 0;
                for (const auto& term : weights[i].terms) {
                    REQUIRE(std::isfinite(term.weight));
                    sum += term.weight;
                    ones += term.weight * 7;  // all values equal
                }
                REQUIRE(std::abs(sum - 1) <= 1e-12);
                REQUIRE(std::abs(ones - 7) <= 1e-11);
                REQUIRE(weights[i].beyond >= 0);
                REQUIRE(weights[i].beyond <= 1);
            }
        }
    }
}

TEST_CASE("A place that is no place has no value") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const auto& spec : family) {
        const auto estimator = estimator_of(spec, uniform_sites(50));
        for (const Vec3& p : {Vec3{nan, 0, 0}, Vec3{500, 500, nan}, Vec3{inf, 0, 0}, Vec3{0, -inf, 0}}) {
            CHECK(weights_at(*estimator, {p}).front().terms.empty());
        }
    }
}
