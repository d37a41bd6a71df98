# The operating characteristic: $simulated, rows (mean, accepted, low, high / %); $exact, rows (mean,
# accepted / %); $limits of a specification, rows (value); `present`, the mean now.
set terminal svg size 560,360 font "sans-serif,15" background "#ffffff"
set xlabel "true mean of the lots"
set ylabel "lots accepted / %"
set xrange [x_low:x_high]
set yrange [-2:102]
set ytics 0,10,100
set format x "%g"
set key outside top center horizontal samplen 2.5 width 2
plot NaN notitle, \
     $exact using 1:2 with lines lt 2 notitle, \
     $simulated using 1:2:3:4 with yerrorbars lt 1 lw 1.6 ps 0.7 title "1", \
     keyentry with lines lt 2 title "2", \
     $limits using 1:(-2):(0):(104) with vectors nohead lc rgb "#8f1010" lw 2.2 dt solid title "3", \
     $present using 1:(-2):(0):(104) with vectors nohead lc rgb "#444444" lw 2 dt (4,4) title "4"
