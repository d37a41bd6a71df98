# Convergence: $curves, a group of rows (number of patches, error / %) for each of `count`.
set xlabel "patches on the hemisphere"
set ylabel "error / %"
set logscale xy
set format x "%.0f"
set format y "%g"
plot NaN notitle, for [i = 1:count] $curves index i - 1 using 1:2 with linespoints lt i ps 0.8 title sprintf("%d", i)
