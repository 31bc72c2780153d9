// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/section_image.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/base/gdal_dataset.hpp"
#include "io/base/gdal_scope.hpp"
#include "io/base/lower_case.hpp"
#include "io/base/output_file.hpp"
#include "io/style/color_map.hpp"
#include "io/style/markup.hpp"
#include "io/style/property_title.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {
namespace {

constexpr int longest_side = 2000;  // pixels
constexpr double drawn_width = 820;
constexpr double drawn_height_max = 620;
constexpr double margin = 60;
constexpr double legend_width = 150;

std::string extension_of(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? "" : lower_case(path.substr(dot + 1));
}

/// In the section's plane.
struct Rectangle {
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    double low = left;
    double high = -left;

    void add(const FlatCorner& c) {
        left = std::min(left, c.along);
        right = std::max(right, c.along);
        low = std::min(low, c.up);
        high = std::max(high, c.up);
    }
    [[nodiscard]] double width() const { return right - left; }
    [[nodiscard]] double height() const { return high - low; }
};

using Polygon = std::vector<FlatCorner>;

double shown(const Property& property, double scaled) {
    return property.kind == Kind::categorical ? std::round(scaled) : from_scale(property, scaled);
}

class SectionImage : public RowSink {
  public:
    SectionImage(const std::string& path, const std::vector<Property>& properties, const Frame& frame, bool overwrite)
        : path_(path), properties_(properties), frame_(frame), file_(path, overwrite) {}

    void begin(const std::vector<RowColumn>&) override {}
    void add(const std::vector<Row>& rows) override {
        for (const Row& row : rows) {
            polygons_.push_back(row.flat);
            in_plan_ = in_plan_ || row.in_plan;
            std::ranges::for_each(row.flat, [&](const FlatCorner& corner) { around_.add(corner); });
        }
    }
    void end() override {
        if (!(around_.width() > 0 && around_.height() > 0)) {
            throw Error("cannot write " + path_ + ": the section meets no cell of the model");
        }
        write();
        file_.commit();
    }

  protected:
    virtual void write() = 0;

    std::string path_;
    std::vector<Property> properties_;
    Frame frame_;
    OutputFile file_;
    std::vector<Polygon> polygons_;
    Rectangle around_;
    bool in_plan_ = false;
};

class SectionTiff final : public SectionImage {
  public:
    using SectionImage::SectionImage;

  private:
    void write() override {
        file_.close();
        pixel_ = std::max(around_.width(), around_.height()) / longest_side;
        columns_ = std::max(1, static_cast<int>(std::ceil(around_.width() / pixel_ - 1e-9)));
        rows_ = std::max(1, static_cast<int>(std::ceil(around_.height() / pixel_ - 1e-9)));
        const GdalScope scope;
        CPLStringList create;
        create.SetNameValue("COMPRESS", "DEFLATE");
        create.SetNameValue("PREDICTOR", "3");
        create.SetNameValue("INTERLEAVE", "BAND");
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        Dataset dataset(driver->Create(file_.temporary_path().c_str(), columns_, rows_,
                                       static_cast<int>(properties_.size()), GDT_Float64, create.List()));
        if (!dataset) {
            fail(scope);
        }
        place(*dataset);
        for (std::size_t p = 0; p < properties_.size(); ++p) {
            std::vector<double> values = raster(p);
            GDALRasterBand& band = *dataset->GetRasterBand(static_cast<int>(p) + 1);
            describe(band, properties_[p]);
            if (band.RasterIO(GF_Write, 0, 0, columns_, rows_, values.data(), columns_, rows_, GDT_Float64, 0, 0,
                              nullptr) != CE_None) {
                fail(scope);
            }
        }
        dataset.reset();
        if (scope.failed()) {
            fail(scope);
        }
    }

    void place(GDALDataset& dataset) const {
        std::array<double, 6> transform{around_.left, pixel_, 0, around_.high, 0, -pixel_};
        dataset.SetGeoTransform(transform.data());
        OGRSpatialReference crs;
        if (in_plan_ && !frame_.crs_wkt.empty() && crs.SetFromUserInput(frame_.crs_wkt.c_str()) == OGRERR_NONE) {
            crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
            dataset.SetSpatialRef(&crs);
        }
        dataset.SetMetadataItem("AXES", in_plan_ ? "x,y" : "distance,z");
        dataset.SetMetadataItem("LENGTH_UNIT", frame_.unit.c_str());
    }

    static void describe(GDALRasterBand& band, const Property& property) {
        band.SetDescription(property.name.c_str());
        band.SetUnitType(property.unit.c_str());
        band.SetNoDataValue(missing);
        for (std::size_t c = 0; c < property.classes.size(); ++c) {
            band.SetMetadataItem(("CLASS_" + std::to_string(c)).c_str(), property.classes[c].c_str());
        }
    }

    [[nodiscard]] std::vector<double> raster(std::size_t p) const {
        std::vector<double> values(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), missing);
        for (const Polygon& polygon : polygons_) {
            for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                draw({&polygon[0], &polygon[k], &polygon[k + 1]}, p, values);
            }
        }
        return values;
    }

    /// The pixels whose middles lie in the triangle.
    void draw(const std::array<const FlatCorner*, 3>& t, std::size_t p, std::vector<double>& values) const {
        const auto cross_of = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
        const double ux = t[1]->along - t[0]->along, uy = t[1]->up - t[0]->up;
        const double vx = t[2]->along - t[0]->along, vy = t[2]->up - t[0]->up;
        const double area = cross_of(ux, uy, vx, vy);
        if (area == 0) {
            return;
        }
        Rectangle box;
        std::ranges::for_each(t, [&](const FlatCorner* corner) { box.add(*corner); });
        const auto index = [&](double value, int count) {
            return static_cast<int>(std::clamp(value / pixel_ - 0.5, -1.0, static_cast<double>(count)));
        };
        const int first = std::max(0, index(box.left - around_.left, columns_));
        const int last = std::min(columns_ - 1, index(box.right - around_.left, columns_) + 1);
        const int top = std::max(0, index(around_.high - box.high, rows_));
        const int bottom = std::min(rows_ - 1, index(around_.high - box.low, rows_) + 1);
        constexpr double rim = 1e-9;
        for (int row = top; row <= bottom; ++row) {
            for (int column = first; column <= last; ++column) {
                const double x = around_.left + (column + 0.5) * pixel_ - t[0]->along;
                const double y = around_.high - (row + 0.5) * pixel_ - t[0]->up;
                const double b = cross_of(x, y, vx, vy) / area;
                const double c = cross_of(ux, uy, x, y) / area;
                if (b >= -rim && c >= -rim && b + c <= 1 + rim) {
                    const double scaled = (1 - b - c) * t[0]->values[p] + b * t[1]->values[p] + c * t[2]->values[p];
                    values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                           static_cast<std::size_t>(column)] = shown(properties_[p], scaled);
                }
            }
        }
    }

    [[noreturn]] void fail(const GdalScope& scope) const {
        throw Error("cannot write " + path_ + (scope.failed() ? ": " + scope.failure() : ""));
    }

    double pixel_ = 1;
    int columns_ = 1;
    int rows_ = 1;
};

class SectionSvg final : public SectionImage {
  public:
    using SectionImage::SectionImage;

  private:
    void write() override {
        scale_ = std::min(drawn_width / around_.width(), drawn_height_max / around_.height());
        const double panel = around_.height() * scale_ + 2 * margin;
        std::string text = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
            "{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
            "fill=\"white\"/>\n",
            around_.width() * scale_ + 2 * margin + legend_width, panel * static_cast<double>(properties_.size()));
        for (std::size_t p = 0; p < properties_.size(); ++p) {
            text += fmt::format("<g transform=\"translate({:.0f},{:.2f})\">\n", margin,
                                panel * static_cast<double>(p) + margin);
            draw(p, text);
            text += "</g>\n";
        }
        file_.write(text + "</svg>\n");
    }

    [[nodiscard]] double x(double along) const { return (along - around_.left) * scale_; }
    [[nodiscard]] double y(double up) const { return (around_.high - up) * scale_; }

    void draw(std::size_t p, std::string& text) const {
        const Property& property = properties_[p];
        static const ColorMap map = ColorMap::named("viridis");
        std::vector<double> means;
        double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
        for (const Polygon& polygon : polygons_) {
            double sum = 0;
            std::ranges::for_each(polygon, [&](const FlatCorner& corner) { sum += corner.values[p]; });
            means.push_back(sum / static_cast<double>(polygon.size()));
            if (!std::isnan(means.back())) {
                lowest = std::min(lowest, means.back());
                highest = std::max(highest, means.back());
            }
        }
        const auto color = [&](double mean) {
            return std::isnan(mean) ? missing_color
                   : property.kind == Kind::categorical
                       ? class_color(static_cast<std::size_t>(std::round(mean)))
                       : map.at(highest > lowest ? (mean - lowest) / (highest - lowest) : 0.5);
        };
        text +=
            fmt::format("<text x=\"0\" y=\"-16\" font-size=\"14\">{}</text>\n", markup_text(property_title(property)));
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            const std::string fill = hex(color(means[i]));
            text += fmt::format("<polygon fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.3\" points=\"", fill);
            for (const FlatCorner& corner : polygons_[i]) {
                text += fmt::format("{:.2f},{:.2f} ", x(corner.along), y(corner.up));
            }
            text.back() = '"';
            text += "/>\n";
        }
        draw_axes(text);
        draw_legend(property, lowest, highest, map, text);
    }

    void draw_axes(std::string& text) const {
        const double width = around_.width() * scale_, height = around_.height() * scale_;
        text +=
            fmt::format("<rect width=\"{:.2f}\" height=\"{:.2f}\" fill=\"none\" stroke=\"#444\"/>\n", width, height);
        constexpr int ticks = 4;
        for (int i = 0; i <= ticks; ++i) {
            const double part = static_cast<double>(i) / ticks;
            text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{:.0f}</text>\n", part * width,
                                height + 16, around_.left + part * around_.width());
            text += fmt::format("<text x=\"-6\" y=\"{:.2f}\" text-anchor=\"end\">{:.0f}</text>\n",
                                height * (1 - part) + 4, around_.low + part * around_.height());
        }
        text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{} [{}]</text>\n", width / 2,
                            height + 34, in_plan_ ? "x, and y upwards" : "distance, and height upwards",
                            markup_text(frame_.unit));
    }

    void draw_legend(const Property& property, double lowest, double highest, const ColorMap& map,
                     std::string& text) const {
        const double at = around_.width() * scale_ + 24;
        if (property.kind == Kind::categorical) {
            for (std::size_t c = 0; c < property.classes.size(); ++c) {
                text += fmt::format(
                    "<rect x=\"{0:.2f}\" y=\"{1}\" width=\"14\" height=\"12\" fill=\"{2}\"/><text x=\"{3:.2f}\" "
                    "y=\"{4}\">{5}</text>\n",
                    at, 18 * c, hex(class_color(c)), at + 20, 18 * c + 11, markup_text(property.classes[c]));
            }
            return;
        }
        constexpr int steps = 32;
        for (int i = 0; i < steps; ++i) {
            text += fmt::format("<rect x=\"{:.2f}\" y=\"{}\" width=\"14\" height=\"6\" fill=\"{}\"/>\n", at, 5 * i,
                                hex(map.at(1 - static_cast<double>(i) / (steps - 1))));
        }
        for (const auto& [value, down] : {std::pair(highest, 10.0), std::pair(lowest, 5.0 * steps)}) {
            text +=
                fmt::format("<text x=\"{:.2f}\" y=\"{}\">{:.4g}</text>\n", at + 20, down, from_scale(property, value));
        }
    }

    double scale_ = 1;
};

}  // namespace

bool is_section_image(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == "tif" || extension == "tiff" || extension == "svg";
}

std::unique_ptr<RowSink> section_to_image(const std::string& path, const std::vector<Property>& properties,
                                          const Frame& frame, bool overwrite) {
    if (extension_of(path) == "svg") {
        return std::make_unique<SectionSvg>(path, properties, frame, overwrite);
    }
    return std::make_unique<SectionTiff>(path, properties, frame, overwrite);
}

}  // namespace terratet
