# SPDX-FileCopyrightText: The Terratet authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The numbers that kriging and variograms are compared with, by R's gstat (Debian: r-cran-gstat):
#     Rscript reference.R FOLDER
# writes samples.csv, places.csv, kriging.csv and variogram.csv there. Those beside this file were made by it.
suppressPackageStartupMessages({library(sp); library(gstat)})
folder <- commandArgs(trailingOnly = TRUE)[1]
write <- function(data, name) {
  write.csv(format(data, digits = 17, trim = TRUE), file.path(folder, name), row.names = FALSE, quote = FALSE)
}

set.seed(20240501)
samples <- data.frame(x = runif(120, 0, 1000), y = runif(120, 0, 800), z = runif(120, -300, 0))
samples$value <- sin(samples$x / 150) + cos(samples$y / 120) + samples$z / 100 + 0.002 * samples$x + rnorm(120, 0, 0.2)
places <- data.frame(x = runif(40, -100, 1100), y = runif(40, -100, 900), z = runif(40, -350, 50))
places[1:3, ] <- samples[c(5, 50, 110), c("x", "y", "z")]  # on samples
write(samples, "samples.csv")
write(places, "places.csv")
coordinates(samples) <- ~x + y + z
coordinates(places) <- ~x + y + z

# gstat's dip is up, ours down; it wants angles from 0 to 360.
cases <- list(
  list("model=spherical:nugget=0.1:sill=1.5:range=300:max_points=12", value ~ 1, vgm(1.5, "Sph", 300, 0.1), list(nmax = 12)),
  list("model=exponential:nugget=0:sill=2:range=120:max_points=20", value ~ 1, vgm(2, "Exp", 120), list(nmax = 20)),
  list("model=gaussian:nugget=0.05:sill=1:range=150:max_points=16", value ~ 1, vgm(1, "Gau", 150, 0.05), list(nmax = 16)),
  list("model=matern:nu=1.5:nugget=0.02:sill=1.2:range=90:max_points=16", value ~ 1,
       vgm(1.2, "Mat", 90, 0.02, kappa = 1.5), list(nmax = 16)),
  list("model=matern:nu=0.8:nugget=0.02:sill=1.2:range=90:max_points=16", value ~ 1,
       vgm(1.2, "Mat", 90, 0.02, kappa = 0.8), list(nmax = 16)),
  list("model=spherical:nugget=0.1:sill=1.5:range=300:max_points=1000", value ~ 1, vgm(1.5, "Sph", 300, 0.1), list()),
  list("model=spherical:nugget=0:sill=1.5:range=250:max_points=40:radius=200", value ~ 1, vgm(1.5, "Sph", 250),
       list(maxdist = 200, nmax = 40)),
  list("drift=linear:model=spherical:nugget=0.1:sill=0.8:range=300:max_points=20", value ~ x + y + z,
       vgm(0.8, "Sph", 300, 0.1), list(nmax = 20)),
  list("drift=linear:model=exponential:nugget=0:sill=0.8:range=100:max_points=1000", value ~ x + y + z,
       vgm(0.8, "Exp", 100), list()),
  list("model=spherical:nugget=0.1:sill=1.5:range=500:azimuth=35:dip=20:roll=10:ratio2=0.6:ratio3=0.3:max_points=1000",
       value ~ 1, vgm(1.5, "Sph", 500, 0.1, anis = c(35, 340, 10, 0.6, 0.3)), list()),
  list("model=exponential:nugget=0:sill=1:range=200:azimuth=300:dip=-40:ratio2=0.5:ratio3=0.25:max_points=1000",
       value ~ 1, vgm(1, "Exp", 200, anis = c(300, 40, 0, 0.5, 0.25)), list()),
  list("model=spherical:nugget=0.1:sill=1.5:range=300:per_octant=2:max_points=16:radius=1e5", value ~ 1,
       vgm(1.5, "Sph", 300, 0.1), list(omax = 2, maxdist = 1e5)))
rows <- NULL
for (case in cases) {
  result <- do.call(krige, c(list(case[[2]], samples, places, model = case[[3]], debug.level = 0), case[[4]]))
  rows <- rbind(rows, data.frame(spec = paste0("kriging:", case[[1]]), place = seq_along(result$var1.pred) - 1,
                                 value = result$var1.pred, variance = result$var1.var))
}
write(rows, "kriging.csv")

rows <- NULL
for (robust in c(FALSE, TRUE)) {
  v <- variogram(value ~ 1, samples, cutoff = 600, width = 40, cressie = robust)
  rows <- rbind(rows, data.frame(robust = as.integer(robust), pairs = v$np, distance = v$dist, semivariance = v$gamma))
}
write(rows, "variogram.csv")
