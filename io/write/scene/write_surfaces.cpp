// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Surfaces back out: barriers, ground and isosurfaces as GOCAD TSurf, OBJ or a GeoPackage of TINs. Of a fault without
/// width both sides are written, each with its own nodes.

#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "io/base/current_time.hpp"
#include "io/base/gdal_dataset.hpp"
#include "io/base/lower_case.hpp"
#include "io/write/mesh_groups.hpp"
#include "io/write/number_lines.hpp"
#include "io/write/scene/scene.hpp"
#include "io/write/scene/scene_text.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// Of one surface, or of one side of it.
struct Sheet {
    std::string name;
    std::string kind;          ///< fault, horizon, topography, domain or isosurface
    int side = 0;              ///< of a fault without width
    std::vector<Vec3> points;  ///< true coordinates
    std::vector<Triangle> triangles;
};

class SheetMaker {
  public:
    SheetMaker(const ModelView& view, const ExportOptions& options)
        : view_(view), options_(options), cells_(scene_cells(view, options.progress)) {}

    std::vector<Sheet> run() {
        if (options_.fault_gap == FaultGap::collapse) {
            add_both_sides();
        }
        for (std::size_t b = 0; b < view_.model.barriers.size(); ++b) {
            const Barrier& barrier = view_.model.barriers[b];
            if (!split_.contains(barrier.name)) {
                ClippedSheet sheet = clipped_sheet(view_.model, b);
                add({barrier.name, to_string(barrier.sheet.kind), 0, std::move(sheet.places),
                     std::move(sheet.triangles)});
            }
        }
        const Coloring coloring(view_, options_.color_property, options_.color_map);
        for (const IsoLevel& level : iso_levels(view_.model, options_, coloring)) {
            const Property& property = view_.model.properties[level.property];
            const CutTriangles cut = isosurface(cells_, level, options_);
            add({property.name + "=" + number_text(from_scale(property, level.scaled)), "isosurface", 0,
                 cut.positions(cells_), cut.triangles});
        }
        return std::move(sheets_);
    }

  private:
    void add(Sheet sheet) {
        std::erase_if(sheet.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
        if (sheet.triangles.empty()) {
            return;
        }
        for (Vec3& point : sheet.points) {
            point = view_.model.frame.to_world(point);
        }
        sheets_.push_back(std::move(sheet));
    }

    /// The facets of faults without width as the mesh has them. Nodes of two sides differ.
    void add_both_sides() {
        const std::vector<Vertex> vertices = cells_.mesh.vertices(view_.model);
        std::map<std::string, const Barrier*> named;
        for (const Barrier& barrier : view_.model.barriers) {
            named[barrier.name] = &barrier;
        }
        for (const MeshGroup& group : mesh_groups(view_, cells_.mesh)) {
            const auto found = named.find(group.name);
            if (group.dimension != 2 || found == named.end() || is_bound(found->second->sheet.kind)) {
                continue;
            }
            split_.insert(group.name);
            for (const int side : {1, -1}) {
                Sheet sheet{group.name, to_string(found->second->sheet.kind), side, {}, {}};
                std::map<std::uint32_t, std::uint32_t> index;
                for (const auto& facet : group.elements) {
                    int sides = 0;
                    for (std::size_t k = 0; k < 3; ++k) {
                        sides += vertices[facet[k]].side;
                    }
                    if ((sides >= 0 ? 1 : -1) != side) {
                        continue;
                    }
                    Triangle corners{};
                    for (std::size_t k = 0; k < 3; ++k) {
                        const auto [entry, fresh] =
                            index.try_emplace(facet[k], static_cast<std::uint32_t>(sheet.points.size()));
                        if (fresh) {
                            sheet.points.push_back(cells_.mesh.points[facet[k]]);
                        }
                        corners[k] = entry->second;
                    }
                    sheet.triangles.push_back(corners);
                }
                add(std::move(sheet));
            }
        }
    }

    const ModelView& view_;
    const ExportOptions& options_;
    SceneCells cells_;
    std::set<std::string> split_;
    std::vector<Sheet> sheets_;
};

/// Names end with the line.
std::string one_line(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return name.empty() ? "unnamed" : name;
}

std::string side_text(const Sheet& sheet) {
    return sheet.side == 0 ? "" : sheet.side > 0 ? " side +" : " side -";
}

/// Sides of a fault are parts of one object.
void write_tsurf(const std::vector<Sheet>& sheets, const Frame& frame, OutputFile& file) {
    NumberLines out(file);
    const char* const unit = frame.metres_per_unit == 1        ? R"("m")"
                             : frame.metres_per_unit == 0.3048 ? R"("ft")"
                                                               : nullptr;  // said by the coordinate system alone
    for (std::size_t first = 0; first < sheets.size();) {
        std::size_t end = first + 1;
        while (end < sheets.size() && sheets[end].side != 0 && sheets[end].name == sheets[first].name) {
            ++end;
        }
        out.line("GOCAD TSurf 1");
        out.line("HEADER {");
        out.line("name: " + one_line(sheets[first].name));
        out.line("}");
        out.line("GOCAD_ORIGINAL_COORDINATE_SYSTEM");
        out.line("NAME", frame.crs_name.empty() ? "Default" : one_line(frame.crs_name));
        out.line("AXIS_NAME \"X\" \"Y\" \"Z\"");
        if (unit != nullptr) {
            out.line("AXIS_UNIT", unit, unit, unit);
        }
        out.line("ZPOSITIVE Elevation");
        out.line("END_ORIGINAL_COORDINATE_SYSTEM");
        std::size_t before = 1;
        for (; first < end; ++first) {
            const Sheet& sheet = sheets[first];
            out.line("TFACE");
            for (std::size_t i = 0; i < sheet.points.size(); ++i) {
                out.line("VRTX", before + i, sheet.points[i].x, sheet.points[i].y, sheet.points[i].z);
            }
            for (const auto& [a, b, c] : sheet.triangles) {
                out.line("TRGL", before + a, before + b, before + c);
            }
            before += sheet.points.size();
        }
        out.line("END");
    }
    out.flush();
}

void write_obj(const std::vector<Sheet>& sheets, OutputFile& file) {
    NumberLines out(file);
    std::size_t before = 1;
    for (const Sheet& sheet : sheets) {
        out.line("o", one_line(sheet.name) + side_text(sheet));
        for (const Vec3& p : sheet.points) {
            out.line("v", p.x, p.y, p.z);
        }
        for (const auto& [a, b, c] : sheet.triangles) {
            out.line("f", before + a, before + b, before + c);
        }
        before += sheet.points.size();
    }
    out.flush();
}

class TinFile {
  public:
    TinFile(const std::string& path, OutputFile& file) : path_(path) {
        file.close();
        unlink(file.temporary_path().c_str());  // the driver insists on making it
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
        dataset_.reset(driver ? driver->Create(file.temporary_path().c_str(), 0, 0, 0, GDT_Unknown, nullptr) : nullptr);
        require(dataset_ != nullptr);
    }

    void write(const std::vector<Sheet>& sheets, const Frame& frame) {
        OGRSpatialReference reference;
        const bool known = !frame.crs_wkt.empty() && reference.importFromWkt(frame.crs_wkt.c_str()) == OGRERR_NONE;
        OGRLayer* const layer = dataset_->CreateLayer("surfaces", known ? &reference : nullptr, wkbTINZ, nullptr);
        require(layer != nullptr);
        for (const auto& [name, type] : {std::pair("name", OFTString),
                                         {"kind", OFTString},
                                         {"side", OFTInteger},
                                         {"area", OFTReal},
                                         {"dip", OFTReal},
                                         {"dip_direction", OFTReal}}) {
            OGRFieldDefn field(name, type);
            require(layer->CreateField(&field) == OGRERR_NONE);
        }
        require(dataset_->StartTransaction() == OGRERR_NONE);
        for (const Sheet& sheet : sheets) {
            const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
            Surface surface;
            surface.vertices = sheet.points;
            surface.triangles = sheet.triangles;
            const SurfaceStatistics measured = statistics(surface);
            feature->SetField("name", sheet.name.c_str());
            feature->SetField("kind", sheet.kind.c_str());
            feature->SetField("side", sheet.side);
            feature->SetField("area", measured.area);
            feature->SetField("dip", measured.dip_mean_deg);
            feature->SetField("dip_direction", measured.dip_direction_deg);
            feature->SetGeometryDirectly(tin_of(sheet).release());
            require(layer->CreateFeature(feature.get()) == OGRERR_NONE);
        }
        require(dataset_->CommitTransaction() == OGRERR_NONE);
        dataset_.reset();
        require(!scope_.failed());
    }

  private:
    static std::unique_ptr<OGRGeometry> tin_of(const Sheet& sheet) {
        auto tin = std::make_unique<OGRTriangulatedSurface>();
        for (const Triangle& t : sheet.triangles) {
            std::array<OGRPoint, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& p = sheet.points[t[k]];
                corners[k] = OGRPoint(p.x, p.y, p.z);
            }
            OGRTriangle triangle(corners[0], corners[1], corners[2]);
            tin->addGeometry(&triangle);
        }
        return tin;
    }

    void require(bool done) const {
        if (!done) {
            throw Error("cannot write " + path_ + (scope_.failed() ? ": " + scope_.failure() : ""));
        }
    }

    GdalScope scope_;
    GeoPackageTime now_;
    std::string path_;
    Dataset dataset_;
};

}  // namespace

OutputRecord write_surfaces(const ModelView& view, const std::string& path, const ExportOptions& options) {
    const std::string extension = lower_case(std::filesystem::path(path).extension().string());
    if (extension != ".ts" && extension != ".obj" && extension != ".gpkg") {
        throw UsageError("'" + path + "': surfaces are written as .ts, .obj or .gpkg");
    }
    OutputFile file(path, options.overwrite);
    const std::vector<Sheet> sheets = SheetMaker(view, options).run();
    if (extension == ".gpkg") {
        TinFile(path, file).write(sheets, view.model.frame);
    } else if (extension == ".ts") {
        write_tsurf(sheets, view.model.frame, file);
    } else {
        write_obj(sheets, file);
    }
    return {path, file.commit(), {}};
}

}  // namespace terratet
