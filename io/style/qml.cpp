// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/qml.hpp"

#include <fmt/format.h>

#include <cmath>

#include "io/style/markup.hpp"
#include "io/style/number_text.hpp"
#include "io/style/qml_symbols.hpp"

namespace terratet {
namespace {

constexpr int class_count = 10;
constexpr double beyond_all = 1e300;  // what QGIS reads back as a number, unlike infinity

std::string renderer(const char* type, const std::string& attributes, const std::string& inner) {
    constexpr const char* by_height =
        R"(<orderby><orderByClause asc="1" nullsFirst="0">z_min($geometry)</orderByClause></orderby>)";
    return fmt::format(
        R"(<renderer-v2 type="{}" forceraster="0" symbollevels="0" enableorderby="1"{}>{}{}</renderer-v2>)", type,
        attributes, inner, by_height);
}

std::string quoted(const std::string& text, char quote) {
    std::string result(1, quote);
    for (const char c : text) {
        result += c == quote || c == '\\' ? std::string{c == quote ? quote : '\\', c} : std::string(1, c);
    }
    return result + quote;
}

std::string classes(const Property& property, const std::string& attribute, double size) {
    std::string categories;
    std::string symbols;
    for (std::size_t i = 0; i < property.classes.size(); ++i) {
        const std::string name = markup_text(property.classes[i]);
        categories += fmt::format(R"(<category value="{0}" symbol="{1}" label="{0}" render="true"/>)", name, i);
        symbols += qml_marker(std::to_string(i), class_color(i), size);
    }
    return renderer("categorizedSymbol", attribute,
                    "<categories>" + categories + "</categories><symbols>" + symbols + "</symbols>");
}

std::string labels(const std::string& column) {
    return fmt::format(
        R"q(<labeling type="simple"><settings calloutType="simple"><text-style fieldName="{}" isExpression="0" )q"
        R"q(fontSize="8" fontSizeUnit="Point" textColor="30,30,30,255" textOpacity="1">)q"
        R"q(<text-buffer bufferDraw="1" bufferSize="0.8" bufferSizeUnits="MM" bufferColor="255,255,255,255" )q"
        R"q(bufferOpacity="0.8"/></text-style>)q"
        R"q(<placement placement="6" dist="1" distUnits="MM" geometryGenerator="start_point($geometry)" )q"
        R"q(geometryGeneratorEnabled="1" geometryGeneratorType="PointGeometry"/>)q"
        R"q(<rendering drawLabels="1" obstacle="1" scaleVisibility="0"/></settings></labeling>)q",
        markup_text(column));
}

}  // namespace

std::string qml_column(const std::string& name) {
    return quoted(name, '"');
}

std::string qml_text(const std::string& text) {
    return quoted(text, '\'');
}

std::string qml_single(const std::string& symbol) {
    return renderer("singleSymbol", "", "<symbols>" + symbol + "</symbols>");
}

std::string qml_rules(const std::vector<StyleRule>& rules) {
    std::string list;
    std::string symbols;
    for (std::size_t i = 0; i < rules.size(); ++i) {
        list += fmt::format(R"(<rule key="rule{0}" filter="{1}" label="{2}" symbol="{0}"{3}/>)", i,
                            markup_text(rules[i].filter), markup_text(rules[i].label),
                            rules[i].shown ? "" : R"( checkstate="0")");
        symbols += rules[i].symbol;
    }
    return renderer("RuleRenderer", "", R"(<rules key="rules">)" + list + "</rules><symbols>" + symbols + "</symbols>");
}

std::string qml_values(const Property& property, const std::string& column, const ColorRange& range,
                       const ColorMap& map, double size) {
    const std::string attribute = fmt::format(R"( attr="{}")", markup_text(qml_column(column)));
    if (property.kind == Kind::categorical) {
        return classes(property, attribute, size);
    }
    const int count = range.high > range.low ? class_count : 1;
    const auto bound = [&](int i) { return from_scale(property, range.low + (range.high - range.low) * i / count); };
    std::string ranges;
    std::string symbols;
    for (int i = 0; i < count; ++i) {
        const bool first = i == 0;
        const bool last = i == count - 1;
        const std::string label = count == 1 ? number_text(bound(0))
                                  : first    ? "< " + number_text(bound(1))
                                  : last     ? "≥ " + number_text(bound(i))
                                             : number_text(bound(i)) + " – " + number_text(bound(i + 1));
        ranges += fmt::format(R"(<range lower="{}" upper="{}" symbol="{}" label="{}" render="true"/>)",
                              first ? -beyond_all : bound(i), last ? beyond_all : bound(i + 1), i, markup_text(label));
        symbols += qml_marker(std::to_string(i), map.at((i + 0.5) / count), size);
    }
    return renderer("graduatedSymbol", R"( graduatedMethod="GraduatedColor")" + attribute,
                    "<ranges>" + ranges + "</ranges><symbols>" + symbols + "</symbols>");
}

std::string qml_document(const std::string& renderer, const std::vector<ColumnLabel>& columns,
                         const std::string& label_column) {
    std::string aliases;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        aliases += fmt::format(R"(<alias field="{}" name="{}" index="{}"/>)", markup_text(columns[i].column),
                               markup_text(columns[i].title), i);
    }
    return fmt::format(
        "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
        R"(<qgis version="3.22.0" styleCategories="Symbology|Labeling|Fields" labelsEnabled="{}">)"
        "{}{}<aliases>{}</aliases></qgis>\n",
        label_column.empty() ? 0 : 1, renderer, label_column.empty() ? "" : labels(label_column), aliases);
}

}  // namespace terratet
