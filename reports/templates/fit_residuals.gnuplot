# Residuals: $values, groups of rows (abscissa, residual / u), one for each of `count` models.
set xlabel is_spectrum ? "wavelength / nm" : "angle from the mirror direction / deg"
set ylabel "(observed - fitted) / u"
set format y "%g"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
set key off
set xzeroaxis
plot for [i = 1:count] $values index i - 1 using 1:2 with points lt i pt 7 ps 0.4
