# Residuals over wavelength: $residuals, a group of rows (wavelength / nm, residual / u) for each of
# `count` spectra.
set ylabel "residual / standard uncertainty"
set xlabel "wavelength / nm"
set format y "%g"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
plot NaN notitle, -2 with lines lc rgb "#888888" dt (6,4) lw 1 notitle, 2 with lines lc rgb "#888888" dt (6,4) lw 1 notitle, for [i = 1:count] $residuals index i - 1 using 1:2 with points lt i ps 0.6 title sprintf("%d", i)
