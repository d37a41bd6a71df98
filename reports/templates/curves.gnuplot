# Curves over wavelength: $curves, a group of rows (wavelength / nm, value) for each of `count`.
# They are, by `kind`, weights (0), reflectances (1) or radiance factors (2).
set ylabel kind == 0 ? "source times responsivity, of sum 1" : kind == 1 ? "reflectance into the receptor" : "radiance factor"
set xlabel "wavelength / nm"
set format y "%g"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
plot NaN notitle, for [i = 1:count] $curves index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
