# A program for `mceip conform`: every support by `eigen`, for Julia with the package JSON.
#
#     mceip conform --as-pencil --lines -- julia spec/examples/adapter.jl
#
# Reads a pencil (mceip-problem/1) on each line of stdin and prints mceip-solutions/1 in one line.
# It is adapter.py in another language: floats and one tolerance, so that repeated roots, biactive
# indices, cones, continua and blocks whose first and last matrices are singular are beyond it.
using JSON
using LinearAlgebra

const TOLERANCE = 1e-8

"An exact entry (\"1/3\", \"0.1\", 2) as a double."
function number(value)
    value isa Number && return Float64(value)
    occursin('/', value) || return parse(Float64, value)
    p, q = split(value, '/')
    return Float64(parse(BigInt, p) // parse(BigInt, q))
end

"{rows, cols, entries} with exact entries, as doubles."
function dense(m)
    out = zeros(m["rows"], m["cols"])
    for (i, j, v) in m["entries"]
        out[i + 1, j + 1] = number(v)
    end
    return out
end

"(t, x) with (A + tB) x = 0, or (A + tB + t^2 C) x = 0, t real: by the last matrix where it is
regular, else by the first one and 1/t."
function eigenpairs(matrices)
    n = size(matrices[1], 1)
    by_last = rank(matrices[end]) == n
    ordered = by_last ? matrices : reverse(matrices)
    pairs = Tuple{Float64, Vector{Float64}}[]
    rank(ordered[end]) < n && return pairs # both singular: given up
    before = n * (length(ordered) - 2)
    blocks = reduce(hcat, [-(ordered[end] \ m) for m in ordered[1:end-1]])
    companion = [zeros(before, n) Matrix{Float64}(I, before, before); blocks] # of x, t x, ...
    values, vectors = eigen(companion)
    for (k, value) in enumerate(values)
        is_real = abs(imag(value)) < TOLERANCE * (1 + abs(value))
        if is_real && (by_last || abs(value) > TOLERANCE)
            push!(pairs, (by_last ? real(value) : 1 / real(value), real.(vectors[1:n, k])))
        end
    end
    return pairs
end

"Every support: an eigenvector of its block that is positive there, with y >= 0 elsewhere."
function solutions(matrices, free, low, high)
    n = size(matrices[1], 1)
    scale = maximum(maximum(abs, m) for m in matrices)
    slip = setdiff(1:n, free)
    found = Dict{String, Any}[]
    for code in 1:(2^length(slip) - 1)
        support = [slip[k] for k in eachindex(slip) if code >> (k - 1) & 1 == 1]
        active = sort([free; support])
        for (t, vector) in eigenpairs([m[active, active] for m in matrices])
            low - TOLERANCE <= t <= high + TOLERANCE || continue
            total = sum(vector[[i in support for i in active]])
            x = zeros(n)
            x[active] = vector / (total == 0 ? 1 : total)
            y = sum(t^(k - 1) * (m * x) for (k, m) in enumerate(matrices))
            rest = setdiff(slip, support)
            is_positive = all(x[support] .> TOLERANCE)
            if is_positive && all(y[rest] .>= -TOLERANCE * scale)
                push!(found, Dict("value" => max(low, t), "x" => x))
            end
        end
    end
    return found
end

"The report on a problem."
function report(problem)
    pencil, window = problem["pencil"], problem["window"]
    low = window["min"] === nothing ? -Inf : number(window["min"])
    high = window["max"] === nothing ? Inf : number(window["max"])
    free = Int[i + 1 for i in get(pencil, "free", [])]
    matrices = [dense(pencil[name]) for name in ("a", "b", "c") if haskey(pencil, name)]
    found = solutions(matrices, free, low, high)
    return Dict("format" => "mceip-solutions/1", "solutions" => found)
end

for line in eachline(stdin)
    println(JSON.json(report(JSON.parse(line))))
    flush(stdout)
end
