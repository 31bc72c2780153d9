# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A model as QGIS's library opens and draws it, without a display: titles, styles, and the picture's colours.

    draw_qgis.py MODEL.gpkg PICTURE.png [--categorical]

Prints what it found as JSON."""
import json
import os
import sys

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
from qgis.core import (QgsApplication, QgsMapRendererParallelJob, QgsMapSettings, QgsRenderContext, QgsVectorLayer)
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor

SIZE = 900


def opened(path, name):
    layer = QgsVectorLayer(f"{path}|layername={name}", name, "ogr")
    assert layer.isValid(), f"{name} does not open"
    return layer


def symbol_colours(layer):
    """Of each feature that has a symbol: where it is, and in which colour it is to be drawn."""
    context = QgsRenderContext()
    renderer = layer.renderer().clone()
    renderer.startRender(context, layer.fields())
    found = []
    for feature in layer.getFeatures():
        context.expressionContext().setFeature(feature)
        symbol = renderer.symbolForFeature(feature, context)
        if symbol is not None:
            found.append((feature.geometry().asPoint(), symbol.color().name()))
    renderer.stopRender(context)
    return found


def drawn(layers, picture):
    settings = QgsMapSettings()
    settings.setOutputSize(QSize(SIZE, SIZE))
    settings.setBackgroundColor(QColor("white"))
    settings.setLayers(layers)  # the first on top
    settings.setDestinationCrs(layers[0].crs())
    extent = layers[0].extent()
    for layer in layers:
        if layer.featureCount() > 0:
            extent.combineExtentWith(layer.extent())
    extent.scale(1.1)
    settings.setExtent(extent)
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    assert not job.errors(), [error.message for error in job.errors()]
    image = job.renderedImage()
    assert image.save(picture)
    return image, settings.mapToPixel()


def main(path, picture, *options):
    application = QgsApplication([], False)
    application.initQgis()
    names = ("boreholes", "samples", "surfaces", "vertices")
    layers = {name: opened(path, name) for name in names}
    found = {}
    for name, layer in layers.items():
        number, ids, styles, _, error = layer.listStylesInDatabase()
        assert not error, error
        found[name] = {"features": layer.featureCount(), "renderer": layer.renderer().type(), "styles": styles[:number],
                       "description": layer.dataProvider().dataComment(), "index": layer.hasSpatialIndex() == 2,
                       "titles": {field.name(): layer.attributeDisplayName(i) for i, field in enumerate(layer.fields())}}
    samples = symbol_colours(layers["samples"])
    found["samples"]["colours"] = len({colour for _, colour in samples})
    found["samples"]["drawn"] = len(samples)
    found["legend"] = [item.label() for item in layers["samples"].renderer().legendSymbolItems()]
    found["rules"] = {item.label(): layers["surfaces"].renderer().legendSymbolItemChecked(item.ruleKey())
                      for item in layers["surfaces"].renderer().legendSymbolItems()}
    found["hole_labels"] = layers["boreholes"].labelsEnabled() and layers["boreholes"].labeling().settings().fieldName

    # Of samples with nobody near, the middle of the disc has the symbol's colour.
    image, to_pixel = drawn([layers["samples"]], picture.replace(".png", "-samples.png"))
    places = [(to_pixel.transform(point), colour) for point, colour in samples]
    alone = [(place, colour) for i, (place, colour) in enumerate(places)
             if all(i == j or abs(place.x() - other.x()) + abs(place.y() - other.y()) > 12 for j, (other, _) in enumerate(places))]
    found["alone"] = len(alone)
    found["as_in_legend"] = sum(image.pixelColor(round(place.x()), round(place.y())).name() == colour for place, colour in alone)

    image, _ = drawn([layers["boreholes"], layers["samples"], layers["surfaces"]], picture)
    colours = {}
    for x in range(image.width()):
        for y in range(image.height()):
            name = image.pixelColor(x, y).name()
            colours[name] = colours.get(name, 0) + 1
    found["painted"] = 1 - colours.get("#ffffff", 0) / SIZE ** 2
    print(json.dumps(found))
    sys.stdout.flush()
    os._exit(0)  # leaving QGIS in an orderly way crashes now and then


if __name__ == "__main__":
    main(*sys.argv[1:])
