// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/gdal_scope.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <gdal_priv.h>

#include <mutex>

#include "io/base/network.hpp"
#include "io/source.hpp"

namespace terratet {
namespace {

void handle(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity >= CE_Failure) {
        static_cast<GdalScope*>(CPLGetErrorHandlerUserData())->take(message);
    }
}

/// How many scopes of this thread are for a source on a network; `in_cloud` of those need more than its own address:
/// credentials are fetched.
thread_local int on_network = 0;
thread_local int in_cloud = 0;

/// In place of a fetch: fails.
CPLHTTPResult* refuse(const char* address, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc, void*, void*) {
    if (in_cloud > 0) {
        return nullptr;  // GDAL's own way
    }
    const std::string message =
        std::string("the file names ") + address + ", but no file makes this program use the network";
    auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup(message.c_str());
    CPLError(CE_Failure, CPLE_NotSupported, "%s", message.c_str());
    return result;
}

bool is_cloud(const std::string& source) {
    return names_network(source) && source.find("/vsicurl") == std::string::npos && !is_connection(source);
}

}  // namespace

GdalScope::GdalScope(const std::string& source)
    : on_network_(names_network(source)),
      in_cloud_(is_cloud(source)),
      // The one file that may then be opened on a network has no name that there could be.
      remote_files_("CPL_VSIL_CURL_ALLOWED_FILENAME", on_network_ || on_network > 0 ? nullptr : "/vsicurl/none") {
    static std::once_flag registered;
    std::call_once(registered, [] { GDALAllRegister(); });
    on_network += on_network_ ? 1 : 0;
    in_cloud += in_cloud_ ? 1 : 0;
    CPLPushErrorHandlerEx(&handle, this);
    CPLHTTPPushFetchCallback(&refuse, nullptr);
}

GdalScope::~GdalScope() {
    CPLHTTPPopFetchCallback();
    CPLPopErrorHandler();
    on_network -= on_network_ ? 1 : 0;
    in_cloud -= in_cloud_ ? 1 : 0;
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
