# How values are spread: $bins, rows (middle, count, width); $normal, rows (value, count of a normal
# distribution); $limits of a specification, rows (value); $guards, rows (low, high) of the bands
# about them; the names of the curves end with those of `names`: 2 without limits, 3, or 4 with bands.
set terminal svg size 560,350 font "sans-serif,15" background "#ffffff"
set xlabel "mean of a panel"
set ylabel "panels"
set xrange [x_low:x_high]
set yrange [0:y_high]
set format x "%g"
unset grid
set key outside top center horizontal samplen 2 width 2
plot NaN notitle, \
     $guards using (0.5 * ($1 + $2)):(0.5 * y_high):1:2:(0):(y_high) with boxxyerror \
       fc rgb "#c7b37a" fs pattern 6 border lc rgb "#c7b37a" lw 0.8 dt solid notitle, \
     $bins using 1:2:3 with boxes fc rgb "#b9d0e2" fs solid 1.0 border lc rgb "#005a9c" lw 0.8 dt solid notitle, \
     $normal using 1:2 with lines lc rgb "#b34700" lw 2 dt (10,5) notitle, \
     $limits using 1:(0):(0):(y_high) with vectors nohead lc rgb "#8f1010" lw 2.5 dt solid notitle, \
     keyentry with boxes fc rgb "#b9d0e2" fs solid 1.0 border lc rgb "#005a9c" lw 0.8 dt solid title "1", \
     keyentry with lines lc rgb "#b34700" lw 2 dt (10,5) title "2", \
     for [i = 3:names < 3 ? 2 : 3] keyentry with lines lc rgb "#8f1010" lw 2.5 dt solid title "3", \
     for [i = 4:names < 4 ? 3 : 4] keyentry with boxes fc rgb "#c7b37a" fs pattern 6 border lc rgb "#c7b37a" lw 0.8 dt solid title "4"
