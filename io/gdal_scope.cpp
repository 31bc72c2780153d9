// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gdal_scope.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal_priv.h>

#include <mutex>

namespace terratet {
namespace {

void handle(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity >= CE_Failure) {
        static_cast<GdalScope*>(CPLGetErrorHandlerUserData())->take(message);
    }
}

}  // namespace

GdalScope::GdalScope() {
    static std::once_flag registered;
    std::call_once(registered, [] { GDALAllRegister(); });
    CPLPushErrorHandlerEx(&handle, this);
}

GdalScope::~GdalScope() {
    CPLPopErrorHandler();
}

void GdalScope::take(const char* message) {
    if (failure_.empty()) {
        failure_ = message && *message ? message : "unknown reason";
    }
}

GdalOption::GdalOption(const char* key, const char* value) : key_(key) {
    if (const char* before = CPLGetThreadLocalConfigOption(key, nullptr)) {
        before_ = before;
        had_ = true;
    }
    CPLSetThreadLocalConfigOption(key, value);
}

GdalOption::~GdalOption() {
    CPLSetThreadLocalConfigOption(key_, had_ ? before_.c_str() : nullptr);
}

}  // namespace terratet
