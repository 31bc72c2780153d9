// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's elements as rows of its layers (docs/model-file.md).

#include <string>
#include <vector>

#include "io/model/model_meta.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/row_writer.hpp"
#include "io/model_store.hpp"
#include "tess/model.hpp"

namespace terratet {

/// Of a model that is written whole.
RowNumbers numbers_of_new(const Model& model);

class ModelRows {
  public:
    /// Both outlive it.
    ModelRows(const Model& model, const RowNumbers& numbers);

    /// Of a new model.
    explicit ModelRows(const Model& model);

    [[nodiscard]] schema::SampleColumns sample_columns(RowWriter& layer) const;
    [[nodiscard]] schema::VertexColumns vertex_columns(RowWriter& layer) const;

    void borehole(RowWriter& layer, const schema::BoreholeColumns& columns, std::size_t i) const;
    void sample(RowWriter& layer, const schema::SampleColumns& columns, std::size_t i) const;
    void surface(RowWriter& layer, const schema::SurfaceColumns& columns, std::size_t i) const;
    void barrier_part(RowWriter& layer, const schema::SurfaceColumns& columns, std::size_t i, bool margin) const;
    void vertex(RowWriter& layer, const schema::VertexColumns& columns, std::size_t i) const;
    [[nodiscard]] Meta meta() const { return to_meta(model_, columns_, censored_columns_); }

  private:
    [[nodiscard]] Vec3 world(const Vec3& local) const;
    void set_values(RowWriter& layer, const std::vector<Column>& columns,
                    const std::vector<std::vector<double>>& values, std::size_t row) const;
    void set_direction(RowWriter& layer, const schema::BoreholeColumns& columns, const Borehole& hole) const;
    void set_mesh(RowWriter& layer, const schema::SurfaceColumns& columns, const Surface& surface) const;
    [[nodiscard]] std::vector<Seed> seeds_among_vertices(std::size_t fault) const;

    const Model& model_;
    RowNumbers own_;  ///< of a new model
    const RowNumbers& numbers_;
    std::vector<std::string> columns_;
    std::vector<std::string> censored_columns_;
};

/// Throws Error, before anything is written, for a text that a database could not hold.
void require_storable(const Model& model);

/// The same for one text. \param what  "a property's name"
void require_storable(const std::string& text, const std::string& what);

}  // namespace terratet
