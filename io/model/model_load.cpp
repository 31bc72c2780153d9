// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "io/base/library_failure.hpp"
#include "io/model/model_guard.hpp"
#include "io/model/model_meta.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/opened_model.hpp"
#include "io/model/row_index.hpp"
#include "io/model/row_order.hpp"
#include "io/model/shown_mesh.hpp"
#include "io/model_store.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

template <typename T>
std::vector<T> unpack(const LayerReader& layer, std::span<const std::byte> bytes, const char* what) {
    if (bytes.size() % sizeof(T) != 0) {
        layer.fail(std::string(what) + " has a length it cannot have");
    }
    std::vector<T> result(bytes.size() / sizeof(T));
    if (!bytes.empty()) {
        std::memcpy(result.data(), bytes.data(), bytes.size());
    }
    return result;
}

Censoring censoring(const LayerReader& layer, Column column) {
    const auto text = layer.text_at(column).value_or("");
    for (const Censoring known : {Censoring::none, Censoring::below, Censoring::above, Censoring::both}) {
        if (text == to_string(known)) {
            return known;
        }
    }
    layer.fail("\"" + text + "\" is none of <, > and <>");
}

/// Reads all layers of one model from an open dataset, checking every row.
class ModelReader {
  public:
    ModelReader(GDALDataset& dataset, GdalScope& scope, std::string file)
        : dataset_(dataset), scope_(scope), file_(std::move(file)) {}

    Model read(const LoadOptions& options, StoredState* state);

  private:
    LayerReader layer(const char* name) { return {dataset_, scope_, file_, name}; }
    Vec3 local(const LayerReader& layer, const Vec3& world) const {
        const Vec3 position = model_.frame.to_local(world);
        if (!is_acceptable(position)) {
            layer.fail("a place is farther than 1e9 from the frame's origin");
        }
        return position;
    }

    Meta read_meta();
    void read_boreholes();
    void read_samples();
    void read_surfaces();
    void read_vertices();
    Surface read_mesh(const LayerReader& layer, const schema::SurfaceColumns& columns);
    void read_fault_part(const LayerReader& layer, const schema::SurfaceColumns& columns, SurfaceKind kind,
                         bool margin);
    void find_seeds_among_vertices();
    void require_distinct_places() const;
    void require_counts_and_digest(const MetaContent& meta, const LoadOptions& options) const;
    double class_index(const LayerReader& layer, std::size_t property, const std::string& name) const;
    void append_values(const LayerReader& layer, const std::vector<Column>& columns,
                       std::vector<std::vector<double>>& values) const;

    GDALDataset& dataset_;
    GdalScope& scope_;
    std::string file_;
    Model model_;
    std::vector<std::string> columns_;
    std::vector<std::string> censored_columns_;
    std::vector<std::map<std::string, double>> classes_;  ///< of each property
    RowIndex borehole_rows_, sample_rows_;
    RowNumbers numbers_;
    std::map<std::int64_t, std::size_t> fault_of_sheet_row_;
    std::vector<bool> has_margin_;
    std::vector<std::size_t> seeds_among_vertices_;  ///< how many to find there, by fault
};

Meta ModelReader::read_meta() {
    LayerReader layer = this->layer(schema::meta);
    const schema::MetaColumns columns(layer);
    Meta meta;
    while (layer.next()) {
        if (!meta.emplace(layer.required_text_at(columns.key), layer.required_text_at(columns.value)).second) {
            layer.fail("the key " + layer.required_text_at(columns.key) + " occurs twice");
        }
    }
    return meta;
}

double ModelReader::class_index(const LayerReader& layer, std::size_t property, const std::string& name) const {
    const auto found = classes_[property].find(name);
    if (found == classes_[property].end()) {
        layer.fail("\"" + name + "\" is no class of " + model_.properties[property].name);
    }
    return found->second;
}

void ModelReader::append_values(const LayerReader& layer, const std::vector<Column>& columns,
                                std::vector<std::vector<double>>& values) const {
    for (std::size_t p = 0; p < columns.size(); ++p) {
        if (model_.properties[p].kind == Kind::continuous) {
            const double value = layer.number_at(columns[p]);
            layer.require(!std::isinf(value), columns[p], "a finite number");
            values[p].push_back(value);
        } else {
            const auto name = layer.text_at(columns[p]);
            values[p].push_back(name ? class_index(layer, p, *name) : missing);
        }
    }
}

void ModelReader::read_boreholes() {
    LayerReader layer = this->layer(schema::boreholes);
    const schema::BoreholeColumns columns(layer);
    std::set<std::string> ids;
    while (layer.next()) {
        Borehole borehole;
        borehole.id = layer.required_text_at(columns.id);
        layer.require(ids.insert(borehole.id).second, columns.id, "the only borehole of this id");
        const Vec3 collar{layer.required_number_at(columns.collar_x), layer.required_number_at(columns.collar_y),
                          layer.required_number_at(columns.collar_z)};
        const OGRGeometry* const geometry = layer.geometry();
        if (!is_acceptable(collar) || !geometry || wkbFlatten(geometry->getGeometryType()) != wkbLineString ||
            !geometry->Is3D() || !geometry->IsMeasured()) {
            layer.fail("its collar is no place, or its path no line with z and m");
        }
        borehole.collar = local(layer, collar);
        const OGRLineString& line = *geometry->toLineString();
        for (int i = 0; i < line.getNumPoints(); ++i) {
            const Vec3 p{line.getX(i), line.getY(i), line.getZ(i)};
            const double before = borehole.path_depth.empty() ? -max_coordinate : borehole.path_depth.back();
            if (!is_acceptable(p) || !(line.getM(i) >= before && line.getM(i) <= max_coordinate)) {
                layer.fail("point " + std::to_string(i + 1) + " of its path is no place, or not below the one before");
            }
            borehole.path.push_back(local(layer, p));
            borehole.path_depth.push_back(line.getM(i));
        }
        borehole_rows_.add(layer.row_number());
        model_.boreholes.push_back(std::move(borehole));
    }
}

void ModelReader::read_samples() {
    LayerReader layer = this->layer(schema::samples);
    const schema::SampleColumns columns(layer, model_.properties, columns_, censored_columns_);
    Samples& samples = model_.samples;
    samples.values.resize(model_.properties.size());
    std::vector<std::tuple<std::size_t, std::size_t, Censoring>> censored;
    while (layer.next()) {
        std::int32_t borehole = -1;
        if (const auto row = layer.integer_at(columns.hole)) {
            const auto found = borehole_rows_.find(*row);
            if (!found || model_.boreholes[*found].id != layer.text_at(columns.borehole)) {
                layer.fail("its borehole is not in layer boreholes");
            }
            borehole = static_cast<std::int32_t>(*found);
        }
        samples.positions.push_back(local(layer, layer.point()));
        samples.borehole.push_back(borehole);
        samples.depth.push_back(layer.number_at(columns.depth));
        samples.length.push_back(layer.number_at(columns.length));
        layer.require(!(std::abs(samples.depth.back()) > max_coordinate), columns.depth, "a depth within 1e9");
        layer.require(!(samples.length.back() < 0 || samples.length.back() > max_coordinate), columns.length,
                      "a length from 0 to 1e9");
        append_values(layer, columns.values, samples.values);
        for (std::size_t p = 0; p < columns.censored.size(); ++p) {
            if (columns.censored[p]) {
                censored.push_back({p, samples.size() - 1, censoring(layer, *columns.censored[p])});
            }
        }
        sample_rows_.add(layer.row_number());
    }
    for (const auto& [property, sample, censoring] : censored) {
        samples.set_censoring(property, sample, censoring);
    }
}

Surface ModelReader::read_mesh(const LayerReader& layer, const schema::SurfaceColumns& columns) {
    Surface surface;
    surface.name = layer.required_text_at(columns.name);
    surface.file = layer.required_text_at(columns.file);
    surface.vertices = unpack<Vec3>(layer, layer.bytes_at(columns.mesh_vertices), "mesh_vertices");
    surface.triangles = unpack<Triangle>(layer, layer.bytes_at(columns.mesh_triangles), "mesh_triangles");
    if (!std::all_of(surface.vertices.begin(), surface.vertices.end(), is_acceptable)) {
        layer.fail("a vertex is no place");
    }
    for (const Triangle& t : surface.triangles) {
        if (*std::max_element(t.begin(), t.end()) >= surface.vertices.size()) {
            layer.fail("a triangle names a vertex that is not there");
        }
    }
    if (!shows(layer.geometry(), surface.vertices, surface.triangles)) {
        layer.fail("its geometry and its mesh columns differ; surfaces change through terratet edit only");
    }
    for (Vec3& p : surface.vertices) {
        p = local(layer, p);
    }
    return surface;
}

void ModelReader::read_fault_part(const LayerReader& layer, const schema::SurfaceColumns& columns, SurfaceKind kind,
                                  bool margin) {
    const std::string name = layer.required_text_at(columns.fault);
    if (margin) {
        if (model_.barriers.empty() || has_margin_.back() || model_.barriers.back().name != name) {
            layer.fail("a margin must follow its fault's sheet");
        }
        model_.barriers.back().margin = read_mesh(layer, columns);
        model_.barriers.back().margin.kind = kind;
        has_margin_.back() = true;
        return;
    }
    Barrier fault;
    fault.name = name;
    fault.sheet = read_mesh(layer, columns);
    fault.sheet.kind = kind;
    fault.spacing = layer.number_at(columns.spacing);
    fault.width = layer.number_at(columns.width);
    fault.covering_radius = layer.number_at(columns.covering_radius);
    fault.protection_radius = layer.number_at(columns.protection_radius);
    layer.require(fault.spacing > 0 && fault.spacing <= max_coordinate, columns.spacing, "a length above 0, up to 1e9");
    for (const auto& [length, column] :
         {std::pair(fault.width, columns.width), std::pair(fault.covering_radius, columns.covering_radius),
          std::pair(fault.protection_radius, columns.protection_radius)}) {
        layer.require(length >= 0 && length <= max_coordinate, column, "a length from 0 to 1e9");
    }
    fault.refined = model_.barrier_options.refine;
    const auto packed = unpack<std::array<double, 4>>(layer, layer.bytes_at(columns.seeds), "seeds");
    for (const auto& [x, y, z, side] : packed) {
        if (!is_acceptable({x, y, z}) || (side != 1 && side != -1 && side != 0)) {
            layer.fail("a seed is no place with a side");
        }
        fault.seeds.push_back({local(layer, {x, y, z}), static_cast<std::int8_t>(side)});
    }
    fault_of_sheet_row_[layer.row_number()] = model_.barriers.size();
    numbers_.sheets.push_back(layer.row_number());
    has_margin_.push_back(false);
    const std::int64_t count = layer.required_integer_at(columns.seed_count);
    const bool packed_here = layer.is_set(columns.seeds) || count == 0;
    if (count < 0 || (packed_here && count != static_cast<std::int64_t>(fault.seeds.size()))) {
        layer.fail("its seeds are not as many as its seed_count");
    }
    seeds_among_vertices_.push_back(packed_here ? 0 : static_cast<std::size_t>(count));
    model_.barriers.push_back(std::move(fault));
}

void ModelReader::read_surfaces() {
    LayerReader layer = this->layer(schema::surfaces);
    const schema::SurfaceColumns columns(layer);
    while (layer.next()) {
        const std::string kind = layer.required_text_at(columns.kind);
        const std::string first = kind.substr(0, kind.find('_'));
        const std::string part = kind.substr(first.size());
        constexpr std::array kinds{SurfaceKind::fault, SurfaceKind::horizon, SurfaceKind::topography,
                                   SurfaceKind::domain};
        const auto known =
            std::find_if(kinds.begin(), kinds.end(), [&](SurfaceKind k) { return to_string(k) == first; });
        if (known == kinds.end() || (!part.empty() && part != "_sheet" && part != "_margin")) {
            layer.fail("\"" + kind + "\" is no kind of surface");
        }
        if (!part.empty()) {
            read_fault_part(layer, columns, *known, part == "_margin");
            continue;
        }
        Surface surface = read_mesh(layer, columns);
        surface.kind = *known;
        numbers_.surfaces.push_back(layer.row_number());
        model_.surfaces.push_back(std::move(surface));
    }
    if (std::find(has_margin_.begin(), has_margin_.end(), false) != has_margin_.end()) {
        throw InputError(file_ + ": layer " + schema::surfaces + ": a fault's margin is missing");
    }
}

void ModelReader::read_vertices() {
    static const std::map<std::string, Role> roles = {
        {"sample", Role::sample}, {"seed", Role::seed}, {"domain", Role::domain}, {"inserted", Role::inserted}};
    LayerReader layer = this->layer(schema::vertices);
    const schema::VertexColumns columns(layer, model_.properties, columns_);
    VertexValues& values = model_.vertex_values;
    values.values.resize(model_.properties.size());
    while (layer.next()) {
        Vertex vertex;
        vertex.id = static_cast<std::uint64_t>(layer.required_integer_at(columns.id));
        if (!model_.vertices.empty() && vertex.id <= model_.vertices.back().id) {
            layer.fail("ids do not ascend");
        }
        const std::string role = layer.required_text_at(columns.role);
        const auto known = roles.find(role);
        const std::int64_t side = layer.required_integer_at(columns.side);
        layer.require(known != roles.end(), columns.role, "sample, seed, domain or inserted");
        vertex.role = known->second;
        layer.require(vertex.role == Role::seed ? side == 1 || side == -1 : side == 0, columns.side,
                      "1 or -1 for a seed, 0 for others");
        vertex.side = static_cast<std::int8_t>(side);
        const auto owner = layer.integer_at(columns.owner);
        if (vertex.role == Role::sample) {
            const auto found = owner ? sample_rows_.find(*owner) : std::nullopt;
            if (!found) {
                layer.fail("its sample is not in layer samples");
            }
            vertex.owner = static_cast<std::int32_t>(*found);
        } else if (vertex.role == Role::seed) {
            const auto found = owner ? fault_of_sheet_row_.find(*owner) : fault_of_sheet_row_.end();
            if (found == fault_of_sheet_row_.end()) {
                layer.fail("its fault is not in layer surfaces");
            }
            vertex.owner = static_cast<std::int32_t>(found->second);
        } else if (owner) {
            layer.fail("a vertex of this role has no owner");
        }
        vertex.position = local(layer, layer.point());
        model_.vertices.push_back(vertex);
        numbers_.vertices.push_back(layer.row_number());
        values.extrapolation.push_back(layer.number_at(columns.extrapolation));
        layer.require(!(values.extrapolation.back() < 0 || values.extrapolation.back() > 1), columns.extrapolation,
                      "a share from 0 to 1");
        append_values(layer, columns.values, values.values);
    }
}

void ModelReader::find_seeds_among_vertices() {
    for (const Vertex& vertex : model_.vertices) {
        const auto fault = static_cast<std::size_t>(vertex.owner);
        if (vertex.role == Role::seed && seeds_among_vertices_[fault] > 0) {
            model_.barriers[fault].seeds.push_back({vertex.position, vertex.side});
        }
    }
    for (std::size_t f = 0; f < model_.barriers.size(); ++f) {
        if (seeds_among_vertices_[f] > 0 && seeds_among_vertices_[f] != model_.barriers[f].seeds.size()) {
            throw InputError(file_ + ": layer " + schema::vertices + " has " +
                             std::to_string(model_.barriers[f].seeds.size()) + " seeds of fault " +
                             model_.barriers[f].name + ", which had " + std::to_string(seeds_among_vertices_[f]));
        }
    }
}

/// A tessellation has one vertex at a place.
void ModelReader::require_distinct_places() const {
    std::vector<std::pair<Vec3, std::uint64_t>> places;
    places.reserve(model_.vertices.size());
    for (const Vertex& vertex : model_.vertices) {
        places.emplace_back(vertex.position, vertex.id);
    }
    std::sort(places.begin(), places.end());
    const auto twice = std::adjacent_find(places.begin(), places.end(),
                                          [](const auto& a, const auto& b) { return a.first == b.first; });
    if (twice != places.end()) {
        throw InputError(file_ + ": layer " + schema::vertices + ": the vertices of id " +
                         std::to_string(twice->second) + " and " + std::to_string(std::next(twice)->second) +
                         " are at the same place");
    }
}

void ModelReader::require_counts_and_digest(const MetaContent& meta, const LoadOptions& options) const {
    if (row_counts(model_) != meta.counts) {
        throw InputError(file_ + ": a layer has more or fewer rows than the model had; it was changed or damaged");
    }
    if (options.accept_edited) {
        return;
    }
    const char* const remedy =
        "; models change through terratet edit only. `accept_edited` takes one that was edited on purpose, if it still "
        "keeps all that terratet check verifies";
    if (meta.digest.empty()) {
        throw InputError(file_ + ": the digest that vouches for its rows is missing" + remedy);
    }
    if (model_digest(model_) != meta.digest) {
        throw InputError(file_ +
                         ": its rows are not those that were stored (the digest differs): another program changed it, "
                         "or it is damaged" +
                         remedy);
    }
}

Model ModelReader::read(const LoadOptions& options, StoredState* state) {
    const Meta pairs = read_meta();
    MetaContent meta = from_meta(pairs, file_);
    model_ = std::move(meta.model);
    columns_ = std::move(meta.property_columns);
    censored_columns_ = std::move(meta.censored_columns);
    for (const Property& property : model_.properties) {
        auto& classes = classes_.emplace_back();
        for (const std::string& name : property.classes) {
            classes.emplace(name, static_cast<double>(classes.size()));
        }
    }
    read_boreholes();
    read_samples();
    read_surfaces();
    read_vertices();
    find_seeds_among_vertices();
    require_distinct_places();
    numbers_.boreholes = borehole_rows_.rows();
    numbers_.samples = sample_rows_.rows();
    if (const auto order = pairs.find("row_order"); order != pairs.end()) {
        put_in_order(order->second, model_, numbers_, file_);
    }
    require_counts_and_digest(meta, options);
    if (state != nullptr) {
        *state = {std::move(numbers_), meta.digest, 0};
    }
    return std::move(model_);
}

}  // namespace

Model load_model(const std::string& path, const LoadOptions& options, StoredState* state) {
    std::vector<JournalEntry> journal = state != nullptr ? load_journal(path) : std::vector<JournalEntry>();
    GdalScope scope(path);
    const Dataset dataset = open_model(path, scope);
    Model model = naming_file(path, [&] { return ModelReader(*dataset, scope, path).read(options, state); });
    for (const JournalEntry& entry : journal) {
        state->last_edit = std::max(state->last_edit, entry.edit);
    }
    return model;
}

}  // namespace terratet
