# Risks over what may be chosen: $risks, for each of `count` a group of rows (value, risk, low, high /
# %); `asked`, the risk that was asked for / %; $marks, rows (value) of what is now, then of the
# answer (`answered`, else a gap); `kind`: 1 readings of a panel, 2 a spread in %, 3 a spread.
set terminal svg size 560,350 font "sans-serif,15" background "#ffffff"
array what[3] = ["readings of a panel", "standard deviation / %", "standard deviation"]
set xlabel what[kind]
set ylabel kind == 1 ? "risk of a lot / %" : "lots refused / %"
set xrange [x_low:x_high]
set yrange [0:y_high]
if (kind == 1) { set xtics 1 }
set format y "%g"
set key outside top center horizontal samplen 2.5 width 2
plot NaN notitle, \
     asked with lines lc rgb "#8f1010" lw 1.8 dt (6,4) notitle, \
     $marks index 0 using 1:(0):(0):(y_high) with vectors nohead lc rgb "#444444" lw 1.8 dt (4,4) notitle, \
     $marks index 1 using 1:(0):(0):(y_high) with vectors nohead lc rgb "#00734f" lw 2.2 dt solid notitle, \
     for [i = 1:count] $risks index i - 1 using 1:2:3:4 with yerrorbars lt i dt solid lw 1.6 ps 0.7 notitle, \
     for [i = 1:count] $risks index i - 1 using 1:2 with linespoints lt i lw 1.6 ps 0.8 title sprintf("%d", i), \
     keyentry with lines lc rgb "#8f1010" lw 1.8 dt (6,4) title sprintf("%d", count + 1), \
     keyentry with lines lc rgb "#444444" lw 1.8 dt (4,4) title sprintf("%d", count + 2), \
     for [i = 1:answered] keyentry with lines lc rgb "#00734f" lw 2.2 dt solid title sprintf("%d", count + 3)
