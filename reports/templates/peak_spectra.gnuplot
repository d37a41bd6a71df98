# f_r over wavelength at the peaks of lobes: $curves, a group of rows (wavelength / nm, f_r) for each
# of `count`.
set ylabel "f_r / (1/sr)"
set xlabel "wavelength / nm"
set format y "%g"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
plot NaN notitle, for [i = 1:count] $curves index i - 1 using 1:2 with lines lt i title sprintf("%d", i)
