# A control chart: $points, rows (number, lowest, mean, highest), where neighbours stand together
# (`thinned`) or all three are one; $signals, for each of four rules rows (number, value); the line
# in the middle `centre` and control limits `lower` and `upper`; zones of one `sigma` (0: none); $limits
# of a specification, rows (value); `kind` says what a point is.
set terminal svg size 560,330 font "sans-serif,15" background "#ffffff"
array what[6] = ["mean of a panel", "range of a panel", "mean of a panel", "moving range", \
  "mean of a run", "moving range of runs"]
set ylabel what[kind]
set xlabel kind > 4 ? "run, the oldest first" : "panel"
set xrange [x_low:x_high]
set yrange [y_low:y_high]
if (x_high - x_low < 12) { set xtics 1 } else { set xtics autofreq }
set format y "%g"
unset grid
set key outside top center horizontal samplen 1.5 width 2
array rule_shape[4] = [4, 8, 12, 10]
array rule_size[4] = [1.7, 1.3, 1.4, 1.3]
array rule_colour[4] = [0xb00020, 0xb34700, 0x6a3d9a, 0x00734f]
if (sigma > 0) {
  do for [z = 1:2] {
    set object 2 * z - 1 rectangle from x_low, centre + z * sigma to x_high, centre + (z + 1) * sigma \
      behind fs solid noborder fc rgb (z == 1 ? "#f1f5f8" : "#e1e8ee")
    set object 2 * z rectangle from x_low, centre - (z + 1) * sigma to x_high, centre - z * sigma \
      behind fs solid noborder fc rgb (z == 1 ? "#f1f5f8" : "#e1e8ee")
  }
}
plot NaN notitle, \
     centre with lines lc rgb "#444444" lw 1.2 dt solid notitle, \
     lower with lines lc rgb "#444444" lw 1.5 dt (8,5) notitle, \
     upper with lines lc rgb "#444444" lw 1.5 dt (8,5) notitle, \
     $limits using (x_low):1:(x_high - x_low):(0) with vectors nohead lc rgb "#8f1010" lw 2 dt (2,3) notitle, \
     $points using 1:(thinned ? $2 : NaN):4 with filledcurves fc rgb "#9fc0da" fs solid 1.0 notitle, \
     $points using 1:3 with lines lc rgb "#005a9c" lw 1 dt solid notitle, \
     $points using 1:(thinned ? NaN : $3) with points lc rgb "#005a9c" pt 7 ps (x_high > 60 ? 0.3 : 0.5) notitle, \
     for [i = 1:rules] $signals index i - 1 using 1:2 with points lc rgb rule_colour[i] lw 2.4 \
       pt rule_shape[i] ps rule_size[i] title sprintf("%d", i)
