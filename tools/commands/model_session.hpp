// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A stored model that is kept in memory, edited and asked: what edit and live have in common.

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "interp/live_model.hpp"
#include "io/model_store.hpp"

namespace terratet::tools {

using Words = std::vector<std::string>;

/// What an edit did to a model, for those who follow it.
struct SessionChange {
    std::shared_ptr<const ModelSnapshot> before;
    std::shared_ptr<const ModelSnapshot> after;
    nlohmann::ordered_json result;
};

class ModelSession {
  public:
    /// Opens it. Throws as open_model does.
    ModelSession(std::string path, bool accept_edited, const Progress& progress = {});

    [[nodiscard]] const std::string& path() const { return path_; }
    /// The newest state. Safe from any thread.
    [[nodiscard]] std::shared_ptr<const ModelSnapshot> snapshot() const;

    /// One edit of one or more verbs, all or nothing: in memory and, unless `dry_run`, in the file. Also undo [N],
    /// redo [N] and history, alone. Returns what was done; the numbers are in docs/live.md. Throws UsageError,
    /// InputError and Error; everything is then as it was.
    nlohmann::ordered_json edit(const std::vector<Words>& verbs, bool dry_run, const Progress& progress = {});

    /// Called after each edit that is done.
    std::function<void(const SessionChange&)> on_change;

  private:
    nlohmann::ordered_json step(const Words& words);
    void reload();
    void tell(std::shared_ptr<const ModelSnapshot> before, const nlohmann::ordered_json& result);

    std::string path_;
    StoredState state_;
    std::shared_ptr<LiveModel> live_;
    mutable std::mutex mutex_;  ///< of the pointer
};

/// Of undo and redo, which take no options.
bool is_step(const Words& words);

/// The journal: a line each edit, oldest first.
nlohmann::ordered_json history_json(const std::string& path);

}  // namespace terratet::tools
