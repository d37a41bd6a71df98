# Where readings are taken on a panel, to scale, in mm: $spots, rows (x, y, length, width, deviation of
# the mean there); $panel, its edge, closed (empty: not known); `bar`, length of the scale bar at
# (`bar_x`, `bar_y`); `most`, the largest deviation without its
# sign; `decimals` of deviations.
set terminal svg size 560,410 font "sans-serif,15" background "#ffffff"
set xlabel "along the plane of measurement / mm"
set ylabel "across it / mm"
set size ratio -1
set xrange [x_low:x_high]
set yrange [y_low:y_high]
unset grid
unset key
set ytics 0, 20
set cbrange [-most:most]
set cbtics most / 2.0
set format cb "%+.2g"
set for [i = 1:8] linetype i dt solid
set palette defined (-1 "#7a5195", 0 "#ffffff", 1 "#e08214")
set arrow from bar_x, bar_y to bar_x + bar, bar_y heads size 0,90 lw 2 lc rgb "#222222" front
set label sprintf("%g mm", bar) at bar_x + bar, bar_y left offset 0.8,0 front
plot NaN notitle, \
     $panel using 1:2 with lines lc rgb "#444444" lw 1.8 dt solid notitle, \
     $spots using 1:2:3:4:(0):5 with ellipses fc palette fs solid 1.0 border lc rgb "#222222" notitle, \
     $spots using 1:2 with points pt 1 ps 0.6 lc rgb "#222222" lw 1 notitle, \
     $spots using 1:($2 + 0.5 * $4):(sprintf(sprintf("%%+.%df", decimals), $5)) with labels offset 0,0.8 font ",14" notitle
