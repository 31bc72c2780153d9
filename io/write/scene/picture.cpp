// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/picture.hpp"

#include <algorithm>
#include <cmath>

#include "io/style/property_title.hpp"
#include "io/write/scene/canvas.hpp"
#include "io/write/scene/raster.hpp"
#include "io/write/scene/scene_text.hpp"

namespace terratet {
namespace {

constexpr Color paper{1, 1, 1};
constexpr Color ink{0.13, 0.15, 0.17};
constexpr Color faint{0.42, 0.45, 0.49};
constexpr Color unreached{0.80, 0.81, 0.83};
constexpr std::uint32_t samples = 2;  ///< a pixel each way

Box3 box_of(const Scene& scene, const Model& model) {
    Box3 box;
    for (int i = 0; i < 8; ++i) {
        box.extend(scene.frame.position(Camera::box_corner(model.domain.extent, i)));
    }
    return box;
}

Color shaded(const Color& color, const Vec3& normal, const Vec3& light) {
    const double bright = 0.55 + 0.45 * std::abs(dot(normal, light));
    return {bright * color.r, bright * color.g, bright * color.b};
}

/// Opaque parts first, then what shines through, the farthest first.
class Drawing {
  public:
    Drawing(Raster& raster, const Camera& camera) : raster_(raster), camera_(camera) {}

    void add(const ScenePart& part) {
        std::vector<RasterCorner> corners;
        corners.reserve(part.positions.size());
        for (std::size_t v = 0; v < part.positions.size(); ++v) {
            Color color = part.colors.empty() ? part.color : part.colors[v];
            if (!part.normals.empty()) {
                color = shaded(color, part.normals[v], camera_.towards_eye());
            }
            Vec3 at = camera_.onto_picture(part.positions[v]);
            at.x *= samples;
            at.y *= samples;
            corners.push_back({at, color});
        }
        for (const auto& [a, b, c] : part.triangles) {
            const std::array<RasterCorner, 3> triangle{corners[a], corners[b], corners[c]};
            if (part.opacity >= 1) {
                raster_.triangle(triangle);
            } else {
                glass_.push_back({triangle[0].at.z + triangle[1].at.z + triangle[2].at.z, part.opacity, triangle});
            }
        }
        for (const auto& [a, b] : part.lines) {
            raster_.line(corners[a], corners[b], 1.2 * samples, 0.9);
        }
    }

    void finish() {
        std::stable_sort(glass_.begin(), glass_.end(),
                         [](const Glass& a, const Glass& b) { return a.nearness < b.nearness; });
        for (const Glass& glass : glass_) {
            raster_.triangle(glass.triangle, glass.opacity);
        }
    }

  private:
    struct Glass {
        double nearness;
        double opacity;
        std::array<RasterCorner, 3> triangle;
    };
    Raster& raster_;
    const Camera& camera_;
    std::vector<Glass> glass_;
};

/// Values along one edge of the box, outside it.
class Axes {
  public:
    Axes(Canvas& canvas, const Camera& camera, const Scene& scene, const Model& model, double size)
        : canvas_(canvas), camera_(camera), scene_(scene), model_(model), size_(size) {}

    void draw() {
        const Box3& e = model_.domain.extent;
        // In front, as the eye is in the south-west: the southern edge, the western one, and the post left of both.
        edge({e.lo.x, e.lo.y, e.lo.z}, {e.hi.x, e.lo.y, e.lo.z}, 0, "x");
        edge({e.lo.x, e.hi.y, e.lo.z}, {e.lo.x, e.lo.y, e.lo.z}, 1, "y");
        edge({e.lo.x, e.hi.y, e.lo.z}, {e.lo.x, e.hi.y, e.hi.z}, 2, "z");
    }

  private:
    void edge(const Vec3& from, const Vec3& to, int axis, const std::string& name) {
        const Frame& frame = model_.frame;
        const double a = frame.to_world(from)[axis];
        const double b = frame.to_world(to)[axis];
        Property plain;
        const double length_on_picture = distance(flat(from), flat(to));
        std::vector<LegendTick> ticks = legend_ticks(plain, {std::min(a, b), std::max(a, b)});
        while (ticks.size() > 2 &&
               length_on_picture / static_cast<double>(ticks.size()) < 4.6 * size_ / (axis == 2 ? 2.5 : 1)) {
            std::vector<LegendTick> fewer;
            for (std::size_t i = 0; i < ticks.size(); i += 2) {
                fewer.push_back(ticks[i]);
            }
            ticks = std::move(fewer);
        }
        const Vec3 outwards = outward(from, to);
        for (const LegendTick& tick : ticks) {
            const double t = (tick.value - a) / (b - a);
            const Vec3 at = flat(from + t * (to - from));
            canvas_.line(at.x, at.y, at.x + 0.4 * size_ * outwards.x, at.y + 0.4 * size_ * outwards.y, 1, faint);
            const Vec3 beside = at + 0.75 * size_ * outwards;
            if (!is_taken(place(beside, outwards, number_text(tick.value, 10)))) {  // at the corner of a narrow box
                put(beside, outwards, number_text(tick.value, 10));
            }
        }
        const std::string title = name + " [" + short_unit(frame) + "]";
        const Vec3 middle = 0.5 * (flat(from) + flat(to));
        double away = 2.4 * size_;
        while (away < 12 * size_ && is_taken(place(middle + away * outwards, outwards, title))) {
            away += 0.2 * size_;
        }
        put(middle + away * outwards, outwards, title);
    }

    /// Where a text would stand beside its place: its left end on the baseline, and its width.
    struct Line {
        double x;
        double y;
        double width;
    };

    Line place(const Vec3& at, const Vec3& outwards, const std::string& text) {
        const double width = canvas_.text_width(text, 0.85 * size_);
        const double left = outwards.x < -0.3 ? width : outwards.x > 0.3 ? 0 : width / 2;
        return {at.x - left, at.y + size_ * (0.35 + 0.45 * outwards.y), width};
    }

    [[nodiscard]] bool is_taken(const Line& line) const {
        return std::ranges::any_of(lines_, [&](const Line& other) {
            return std::abs(line.y - other.y) < 1.1 * size_ && line.x < other.x + other.width + 0.6 * size_ &&
                   other.x < line.x + line.width + 0.6 * size_;
        });
    }

    void put(const Vec3& at, const Vec3& outwards, const std::string& text) {
        lines_.push_back(place(at, outwards, text));
        canvas_.text(lines_.back().x, lines_.back().y, text, 0.85 * size_, faint);
    }

    [[nodiscard]] Vec3 flat(const Vec3& local) const {
        Vec3 at = camera_.onto_picture(scene_.frame.position(local));
        at.z = 0;
        return at;
    }

    /// Across the edge, away from the middle of the box.
    [[nodiscard]] Vec3 outward(const Vec3& from, const Vec3& to) const {
        const Vec3 along = flat(to) - flat(from);
        Vec3 across = Vec3{-along.y, along.x, 0} / std::max(length(along), 1e-9);
        const Vec3 away = 0.5 * (flat(from) + flat(to)) - flat(model_.domain.extent.center());
        return dot(across, away) < 0 ? -across : across;
    }

    Canvas& canvas_;
    const Camera& camera_;
    const Scene& scene_;
    const Model& model_;
    double size_;
    std::vector<Line> lines_;  // written so far
};

/// Of the isosurfaces that nobody asked for only the last is drawn: through several nothing would be seen.
bool is_hidden(const ScenePart& part, const Scene& scene, const ExportOptions& options) {
    if (!options.iso.empty() || part.kind != ScenePart::Kind::isosurface) {
        return false;
    }
    const auto last = std::find_if(scene.parts.rbegin(), scene.parts.rend(),
                                   [](const ScenePart& other) { return other.kind == ScenePart::Kind::isosurface; });
    return &part != &*last;
}

void draw_legend(Canvas& canvas, const Scene& scene, double x, double y, double width, double size) {
    const auto swatch = [&](const std::string& name, const Color& color) {
        canvas.box(x, y, size, size, color);
        canvas.outline(x, y, size, size, faint);
        std::string text = name;
        while (text.size() > 4 && canvas.text_width(text, 0.85 * size) > width - 1.6 * size) {
            text.resize(text.size() - 1);
            while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
                text.pop_back();
            }
            if (canvas.text_width(text + "…", 0.85 * size) <= width - 1.6 * size) {
                text += "…";
                break;
            }
        }
        canvas.text(x + 1.5 * size, y + 0.85 * size, text, 0.85 * size, ink);
        y += 1.55 * size;
    };
    const Coloring& coloring = scene.coloring;
    constexpr std::size_t most = 14;
    const auto classes = [&](const std::vector<std::string>& names) {
        for (std::size_t c = 0; c < std::min(names.size(), most); ++c) {
            swatch(names[c], class_color(c));
        }
        if (names.size() > most) {
            canvas.text(x, y + size, "and " + std::to_string(names.size() - most) + " more", 0.85 * size, faint);
            y += 1.55 * size;
        }
    };
    canvas.text(x, y, coloring.has_property() ? property_title(coloring.property()) : "fault blocks", size, ink,
                Canvas::Align::left, true);
    y += 0.8 * size;
    if (!coloring.has_property()) {
        classes(scene.cells.region_names);
    } else if (coloring.categorical()) {
        classes(coloring.property().classes);
    } else {
        const double height = 15 * size;
        const int steps = static_cast<int>(height);
        for (int i = 0; i < steps; ++i) {
            canvas.box(x, y + height * i / steps, 1.5 * size, height / steps + 0.5,
                       coloring.at_fraction(1 - (i + 0.5) / steps));
        }
        canvas.outline(x, y, 1.5 * size, height, faint);
        for (const LegendTick& tick : legend_ticks(coloring.property(), coloring.range())) {
            const double at = y + height * (1 - tick.fraction);
            canvas.line(x + 1.5 * size, at, x + 1.9 * size, at, 1, faint);
            canvas.text(x + 2.2 * size, at + 0.3 * size, tick.label, 0.85 * size, ink);
        }
        y += height + size;
    }
    if (coloring.has_property()) {
        swatch("no value, or beyond reach", unreached);
    }
    std::size_t barriers = 0;
    for (const ScenePart& part : scene.parts) {
        if (part.kind == ScenePart::Kind::barrier && barriers++ < 8) {
            swatch(part.name, part.color);
        }
    }
}

void draw_north(Canvas& canvas, const Camera& camera, const Box3& box, double x, double y, double size) {
    const Vec3 middle = box.center();
    const Vec3 step{0, 0, -0.05 * length(box.size())};
    Vec3 along = camera.onto_picture(middle + step) - camera.onto_picture(middle);
    along.z = 0;
    along = along / std::max(length(along), 1e-9);
    const Vec3 aside{-along.y, along.x, 0};
    const auto at = [&](double forwards, double sideways) {
        const Vec3 p = forwards * size * along + sideways * size * aside;
        return std::pair(x + p.x, y + p.y);
    };
    canvas.polygon({at(1.6, 0), at(-1, 0.8), at(-0.4, 0), at(-1, -0.8)}, {0.8, 0.2, 0.2});
    const auto [lx, ly] = at(2.5, 0);
    canvas.text(lx, ly + 0.35 * size, "N", size, ink, Canvas::Align::middle, true);
}

}  // namespace

std::string picture_png(const Scene& scene, const ModelView& view, const ExportOptions& options) {
    const auto [width, height] = options.picture_size;
    const double size = std::clamp(std::min(width / 1.6, height / 1.0) / 62.0, 8.0, 40.0);
    const double legend = std::min(15.5 * size, 0.3 * width);
    const Box3 box = box_of(scene, view.model);
    const double stretch = height_stretch(view.model);
    const Camera camera(box, stretch, default_azimuth_deg, default_height_deg,
                        {6.5 * size, 6 * size, width - legend - 8 * size, height - 13 * size});
    Raster raster(width * samples, height * samples, paper);
    Drawing drawing(raster, camera);
    for (const ScenePart& part : scene.parts) {
        if (part.kind != ScenePart::Kind::block && !is_hidden(part, scene, options)) {
            drawing.add(part);
        }
    }
    drawing.finish();

    Canvas canvas(raster.shrunk(samples), width, height);
    Axes(canvas, camera, scene, view.model, size).draw();
    canvas.text(1.6 * size, 2.6 * size, options.title, 1.5 * size, ink, Canvas::Align::left, true);
    std::string second = crs_title(view.model.frame);
    if (stretch != 1) {
        second += " · heights × " + number_text(stretch);
    }
    canvas.text(1.6 * size, 4.4 * size, second, 0.95 * size, faint);
    draw_legend(canvas, scene, width - legend, 6 * size, legend - size, size);
    draw_north(canvas, camera, box, width - 3.5 * size, height - 6 * size, size);
    canvas.text(1.6 * size, height - 1.3 * size, honesty(scene, view), 0.85 * size, faint);
    return canvas.png();
}

}  // namespace terratet
