// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/canvas.hpp"

#include <cairo.h>

#include "tess/error.hpp"

namespace terratet {

struct Canvas::Impl {
    std::vector<std::uint32_t> pixels;
    cairo_surface_t* surface = nullptr;
    cairo_t* context = nullptr;

    void paint(const Color& color, double opacity = 1) const {
        cairo_set_source_rgba(context, color.r, color.g, color.b, opacity);
    }
    void font(double size, bool bold) const {
        cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                               bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(context, size);
    }
};

Canvas::Canvas(std::vector<std::uint32_t> pixels, std::uint32_t width, std::uint32_t height)
    : impl_(std::make_unique<Impl>()) {
    impl_->pixels = std::move(pixels);
    impl_->surface = cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(impl_->pixels.data()),
                                                         CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                                         static_cast<int>(height), static_cast<int>(4 * width));
    impl_->context = cairo_create(impl_->surface);
}

Canvas::~Canvas() {
    cairo_destroy(impl_->context);
    cairo_surface_destroy(impl_->surface);
}

void Canvas::text(double x, double y, const std::string& text, double size, const Color& color, Align align,
                  bool bold) {
    const double width = align == Align::left ? 0 : text_width(text, size, bold);
    impl_->font(size, bold);
    impl_->paint(color);
    cairo_move_to(impl_->context, x - (align == Align::middle ? 0.5 : 1) * width, y);
    cairo_show_text(impl_->context, text.c_str());
}

double Canvas::text_width(const std::string& text, double size, bool bold) {
    impl_->font(size, bold);
    cairo_text_extents_t extents;
    cairo_text_extents(impl_->context, text.c_str(), &extents);
    return extents.x_advance;
}

void Canvas::box(double x, double y, double width, double height, const Color& color, double opacity) {
    impl_->paint(color, opacity);
    cairo_rectangle(impl_->context, x, y, width, height);
    cairo_fill(impl_->context);
}

void Canvas::outline(double x, double y, double width, double height, const Color& color) {
    impl_->paint(color);
    cairo_set_line_width(impl_->context, 1);
    cairo_rectangle(impl_->context, x, y, width, height);
    cairo_stroke(impl_->context);
}

void Canvas::line(double x1, double y1, double x2, double y2, double width, const Color& color) {
    impl_->paint(color);
    cairo_set_line_width(impl_->context, width);
    cairo_move_to(impl_->context, x1, y1);
    cairo_line_to(impl_->context, x2, y2);
    cairo_stroke(impl_->context);
}

void Canvas::polygon(const std::vector<std::pair<double, double>>& corners, const Color& color) {
    impl_->paint(color);
    cairo_new_path(impl_->context);
    for (const auto& [x, y] : corners) {
        cairo_line_to(impl_->context, x, y);
    }
    cairo_close_path(impl_->context);
    cairo_fill(impl_->context);
}

std::string Canvas::png() const {
    std::string bytes;
    const auto append = [](void* to, const unsigned char* data, unsigned int length) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    };
    cairo_surface_flush(impl_->surface);
    if (cairo_surface_write_to_png_stream(impl_->surface, append, &bytes) != CAIRO_STATUS_SUCCESS ||
        cairo_status(impl_->context) != CAIRO_STATUS_SUCCESS) {
        throw Error("Cairo could not draw the picture");
    }
    return bytes;
}

}  // namespace terratet
