# What all charts of pages share. Only numbers come from outside; words stand in the page.
# Lines differ in dashes and points differ in shape, not in colour alone.
set terminal svg size 720,400 font "sans-serif,13" background "#ffffff"
set border lc rgb "#444444"
set grid lc rgb "#dddddd" lt 1 dt solid
set key outside right top samplen 4 spacing 1.2
set linetype 1 lc rgb "#005a9c" lw 2.5 dt solid pt 7
set linetype 2 lc rgb "#b34700" lw 2.5 dt (10,5) pt 5
set linetype 3 lc rgb "#00734f" lw 2.5 dt (3,4) pt 9
set linetype 4 lc rgb "#8f3f97" lw 2.5 dt (12,4,3,4) pt 13
set linetype 5 lc rgb "#5a5a5a" lw 2.5 dt (18,5) pt 6
set linetype 6 lc rgb "#946800" lw 2.5 dt (6,3,6,8) pt 4
set linetype 7 lc rgb "#0b6e8f" lw 2.5 dt (2,2) pt 8
set linetype 8 lc rgb "#a3144d" lw 2.5 dt (14,3,3,3,3,3) pt 12
set linetype cycle 8
